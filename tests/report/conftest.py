"""Pages of the report tests."""

from __future__ import annotations

import pytest
from report_parts import account, study_account

from flexcage.report.page import write_page
from flexcage.report.run_page import run_page
from flexcage.report.study_page import study_page


@pytest.fixture(scope="session")
def run_file(tmp_path_factory):
    """The page of a run, written."""
    return write_page(run_page(account()), tmp_path_factory.mktemp("page") / "run.html")


@pytest.fixture(scope="session")
def study_file(tmp_path_factory):
    """The page of a study of three points, written."""
    folder = tmp_path_factory.mktemp("study")
    return write_page(study_page(study_account(folder)), folder / "study.html")
