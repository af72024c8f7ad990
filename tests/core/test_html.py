"""Parts of what notebooks show: escaped, well-formed, empty where there is nothing."""

from xml.etree import ElementTree

from flexcage.core import html


def test_text_is_escaped_everywhere():
    bad = "<b>&\"'"
    parts = (
        html.paragraphs([bad]), html.bullets([bad]), html.table([[bad]], heads=[bad]),
        html.folded(bad, html.paragraphs([bad])),
    )  # fmt: skip
    tree = ElementTree.fromstring(html.block(bad, *parts))
    assert [e.text for e in tree.iter() if e.text] == [bad] * 7
    assert not list(tree.iter("b"))


def test_columns_are_aligned_and_the_last_side_goes_on():
    tree = ElementTree.fromstring(html.table([["a", "1", "2"]], sides="lr"))
    assert [cell.get("style") for cell in tree.iter("td")] == [
        "text-align:left", "text-align:right", "text-align:right",
    ]  # fmt: skip


def test_nothing_gives_nothing():
    assert html.table([], heads=["a"]) == html.bullets([]) == html.paragraphs([""]) == ""
