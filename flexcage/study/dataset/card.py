"""Cards of a data set: the manifest of ``bearing-datasets``, Markdown for people, and Croissant."""

from __future__ import annotations

import json
from collections import Counter
from collections.abc import Mapping, Sequence
from typing import Any

from flexcage._version import __version__
from flexcage.study.dataset.folder import SCHEMA, Settings
from flexcage.study.dataset.recording import digest
from flexcage.study.dataset.splits import GROUPED

_CITATION = "Simulated with flexcage, whose main page has the entry to cite."
_HIDDEN = "hidden forces and motion over time, of the settled part, in SI"
#: The context that Croissant 1.0 asks for.
_CONTEXT: dict[str, Any] = {
    "@language": "en", "@vocab": "https://schema.org/", "citeAs": "cr:citeAs",
    "column": "cr:column", "conformsTo": "dct:conformsTo",
    "cr": "http://mlcommons.org/croissant/", "rai": "http://mlcommons.org/croissant/RAI/",
    "data": {"@id": "cr:data", "@type": "@json"},
    "dataType": {"@id": "cr:dataType", "@type": "@vocab"}, "dct": "http://purl.org/dc/terms/",
    "equivalentProperty": "cr:equivalentProperty",
    "examples": {"@id": "cr:examples", "@type": "@json"}, "extract": "cr:extract",
    "field": "cr:field", "fileProperty": "cr:fileProperty", "fileObject": "cr:fileObject",
    "fileSet": "cr:fileSet", "format": "cr:format", "includes": "cr:includes",
    "isLiveDataset": "cr:isLiveDataset", "jsonPath": "cr:jsonPath", "key": "cr:key",
    "md5": "cr:md5", "parentField": "cr:parentField", "path": "cr:path",
    "recordSet": "cr:recordSet", "references": "cr:references", "regex": "cr:regex",
    "repeated": "cr:repeated", "replace": "cr:replace", "samplingRate": "cr:samplingRate",
    "sc": "https://schema.org/", "separator": "cr:separator", "source": "cr:source",
    "subField": "cr:subField", "transform": "cr:transform",
}  # fmt: skip
#: What each column of the metadata table holds, where flexcage has more to say than its schema.
COLUMNS = {
    "dataset": "dataset name", "signal_id": "recording and channel",
    "recording_id": "hash of the simulated case", "native_label": "label of the study's point",
    "channel": "name of the sensor", "sensor_location": "the simulated bearing",
    "fs": "sampling rate in Hz", "n_samples": "number of samples",
    "fault_type": "fault(s) of the bearing", "fault_location": "where the fault is, or none",
    "sensor_at_fault": "True where the bearing has a fault",
    "signal_file": "signals/ file holding the samples", "signal_row_group": "row group there",
    "signal_row": "row inside that row group", "quantity": "physical quantity measured",
    "unit": "unit of the samples", "sensitivity": "none: samples are in a physical unit",
    "axis": "direction of the sensor: y along azimuth 0, z along 90 deg",
    "sensor_mounting": "what the sensor sits on or looks at",
    "speed_rpm": "mean speed of the shaft", "speed_profile": "how it changes",
    "load": "size of radial and axial load", "load_unit": "its unit",
    "operating_condition": "speed and load", "fault_origin": "artificial, or none",
    "fault_size_mm": "length of the spall or spot, displacement of the cage; the largest",
    "fault_severity": "range of sizes", "fault_severity_level": "its rank; 0: sound",
    "bearing_id": "geometry of bearing and cage with their faults: equal is the same bearing",
    "bearing_model": "designation", "bpfo": "orders of the shaft at the nominal contact angle",
    "bpfi": "likewise", "bsf": "likewise", "ftf": "likewise",
    "repetition": "repetition of the study's point",
}  # fmt: skip


def manifest(name: str, rows: Sequence[Mapping[str, Any]], settings: Settings) -> bytes:
    """manifest.json as ``bearing-datasets`` reads it."""
    content = "".join(sorted(f"{r['signal_id']}:{r['n_samples']}\n" for r in rows))
    return _json({
        "dataset": name, "title": settings.title or name, "license": settings.license,
        "citation": _CITATION, "package_version": f"flexcage {__version__}",
        "schema_version": SCHEMA, "content_hash": digest(content.encode()),
        "n_recordings": len({row["recording_id"] for row in rows}), "n_signals": len(rows),
        "columns": {c: COLUMNS[c] for c in rows[0]} if rows else {}, "raw_files": [],
    })  # fmt: skip


def readme(
    name: str, rows: Sequence[Mapping[str, Any]], truth: Sequence[Mapping[str, Any]],
    splits: Sequence[Mapping[str, str]], settings: Settings,
) -> bytes:  # fmt: skip
    """The card for people, in Markdown."""
    kinds = Counter((r["fault_type"], r["fault_severity"]) for r in _one_each(rows))
    channels = {r["channel"]: r for r in rows}
    lines = [
        f"# {settings.title or name}", "",
        f"{len(truth)} recordings, {len(rows)} signals, simulated by flexcage {__version__} with a "
        "mechanical model of rings, rolling elements and cage. Licence: "
        f"{settings.license}.", "", "## Classes", "",
        "| fault | severity | recordings |", "|---|---|---|",
        *(f"| {k} | {s} | {n} |" for (k, s), n in sorted(kinds.items())), "",
        "## Channels", "", "| channel | quantity | unit | rate, Hz |", "|---|---|---|---|",
        *(f"| {c} | {r['quantity']} | {r['unit']} | {r['fs']:g} |" for c, r in channels.items()),
        "", "## Splits", "",
        "No bearing, load or seed is on two sides of the split that is named after it.", "",
        "| split | train | validation | test |", "|---|---|---|---|",
        *(_split_line(split, splits) for split in GROUPED), "",
        "## Files", "",
        "- `metadata.parquet`, `signals/`, `manifest.json`: in the schema of `bearing-datasets` "
        f"({SCHEMA}); `bearing_datasets.open(\"{name}\", root=\"the folder above\")` reads them.",
        "- `truth.parquet`: a row a recording: faults, seeds, forces at the fault [N], slip, "
        "whirl, class of motion, energy audit, and all figures of the run in SI (`figure.*`).",
        f"- `truth/`: {_HIDDEN}.",
        "- `splits.parquet`: the splits. `checksums.json`: SHA-256 of every file; `flexcage "
        "dataset check DIR` verifies all of it.", "",
        "## Limits", "",
        "The signals are of a model: its assumptions are on flexcage's pages. Contacts are "
        "elastic, faults do not grow, and transfer paths are the sensors' own resonances.", "",
    ]  # fmt: skip
    return "\n".join(lines).encode()


def _split_line(name: str, rows: Sequence[Mapping[str, str]]) -> str:
    count = Counter(row[name] for row in rows)
    return f"| {name} | {count['train']} | {count['validation']} | {count['test']} |"


def _one_each(rows: Sequence[Mapping[str, Any]]) -> list[Mapping[str, Any]]:
    return list({row["recording_id"]: row for row in rows}.values())


def croissant(
    name: str, rows: Sequence[Mapping[str, Any]], files: Mapping[str, bytes], settings: Settings
) -> bytes:
    """Croissant 1.0: the tables with their checksums, and what their columns hold."""
    objects = [
        {
            "@type": "cr:FileObject", "@id": file, "name": file, "contentUrl": file,
            "encodingFormat": "application/x-parquet", "sha256": digest(content),
        }
        for file, content in files.items()
    ]  # fmt: skip
    first = rows[0] if rows else {}
    fields = [
        {
            "@type": "cr:Field", "@id": f"signals/{column}", "name": column,
            "description": COLUMNS[column], "dataType": _type_of(value),
            "source": {"fileObject": {"@id": "metadata.parquet"}, "extract": {"column": column}},
        }
        for column, value in first.items()
    ]  # fmt: skip
    return _json({
        "@context": _CONTEXT, "@type": "sc:Dataset", "name": name,
        "conformsTo": "http://mlcommons.org/croissant/1.0",
        "description": "Simulated vibration signals of rolling bearings with their truth.",
        "license": settings.license, "version": "1.0.0", "citeAs": _CITATION,
        "distribution": objects,
        "recordSet": [{
            "@type": "cr:RecordSet", "@id": "signals", "name": "signals", "field": fields,
        }],
    })  # fmt: skip


def _type_of(value: Any) -> str:
    if isinstance(value, bool):
        return "sc:Boolean"
    return {int: "sc:Integer", float: "sc:Float"}.get(type(value), "sc:Text")


def _json(table: Any) -> bytes:
    return (json.dumps(table, indent=1) + "\n").encode()
