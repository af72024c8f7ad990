"""Faults told from signals by gradient boosting, of bearings that it has not been trained on."""

import sys
import tomllib
from collections.abc import Sequence
from pathlib import Path

import bearing_datasets as bd
import numpy as np
import pandas as pd
import xarray as xr
from scipy.signal import butter, sosfiltfilt
from sklearn.ensemble import HistGradientBoostingClassifier

from flexcage.case.toml import write_toml
from flexcage.render import sheet
from flexcage.results.spectra import amplitude_spectrum, vibration_figures
from flexcage.study.dataset.build import build_dataset
from flexcage.study.dataset.folder import Settings

STUDY = Path(__file__).with_name("diagnosis_study.toml")
RATE = 51.2e3  # Hz, of the casing's accelerometer
BANDS = ((30.0, 2e3), (2e3, 5e3), (5e3, 10e3), (10e3, 20e3))  # Hz
SENSORS = {"casing alone": ("casing",), "casing and cage laser": ("casing", "cage_laser")}


def main(folder: Path, picture: str = "", *, quick: bool = False) -> dict[str, float]:
    """Share of recordings whose fault is told, by the sensors that are used, and by chance: with
    labels shuffled. The data set is made where it is not there, a small one if ``quick``."""
    if not (folder / "metadata.parquet").exists():
        study = small(folder.with_name("small.toml")) if quick else STUDY
        build_dataset(study, folder, settings=Settings(edges=(0.4e-3,)), workers=2)
    table = recordings(folder)
    told = {name: judged(table, sensors) for name, sensors in SENSORS.items()}
    shares = {}
    for name, found in told.items():
        right = found == table["fault"]
        shares[name] = float(right.mean())
        low, high = by_bearing(right, table["bearing"])
        print(f"{name}: {right.mean():.3f} told, {low:.3f} to {high:.3f}")
        print(by_class(right, table["label"]))
    shuffled = [
        (judged(table, SENSORS["casing and cage laser"], shuffle=k) == table["fault"]).mean()
        for k in range(2 if quick else 10)
    ]
    shares["shuffled labels"] = float(np.mean(shuffled))
    print(
        f"shuffled labels: {np.mean(shuffled):.3f}, from {min(shuffled):.3f} to {max(shuffled):.3f}"
    )
    if picture:
        draw(table, told, picture)
    return shares


def recordings(folder: Path) -> pd.DataFrame:
    """A row a recording: features as "sensor: feature", fault, label and bearing."""
    data = bd.open(folder.name, root=folder.parent)
    truth = pd.read_parquet(folder / "truth.parquet").set_index("recording_id")
    rows = {}
    for row in data.metadata().query("channel in ('casing', 'cage_laser')").itertuples():
        x = np.asarray(data.signal(row.signal_id), float)
        signal = xr.DataArray(x, dims="time", coords={"time": np.arange(len(x)) / row.fs})
        turns = row.speed_rpm / 60.0
        orders = {"FTF": row.ftf, "2 BSF": 2.0 * row.bsf, "BPFO": row.bpfo, "BPFI": row.bpfi}
        lines = {name: order * turns for name, order in orders.items()}
        of = vibration if row.channel == "casing" else displacement
        own = {f"{row.channel}: {name}": value for name, value in of(signal, lines).items()}
        labels = {"fault": row.fault_type, "label": row.native_label}
        labels["bearing"] = truth.loc[row.recording_id, "bearing_seed"]
        rows[row.recording_id] = {**rows.get(row.recording_id, {}), **labels, **own}
    return pd.DataFrame.from_dict(rows, orient="index").sort_values(["fault", "label"])


def vibration(signal: xr.DataArray, lines: dict[str, float]) -> dict[str, float]:
    """RMS, kurtosis, crest factor, share of bands, and envelope lines over the envelope's floor, of
    what is above the lowest band's end."""
    sections = butter(2, BANDS[0][0], "highpass", fs=RATE, output="sos")
    signal = signal.copy(data=sosfiltfilt(sections, signal.values))
    found = vibration_figures(signal, lines)
    figures = {name: found[name] for name in ("rms", "kurtosis", "crest")}
    spectrum = amplitude_spectrum(signal) ** 2
    for low, high in BANDS:
        share = spectrum.sel(frequency=slice(low, high)).sum() / spectrum.sum()
        figures[f"{low / 1e3:g} to {high / 1e3:g} kHz"] = float(share)
    at = [name for name in found if name.startswith("envelope at")]
    return figures | {name: found[name] / found["envelope floor"] for name in at}


def displacement(signal: xr.DataArray, lines: dict[str, float]) -> dict[str, float]:
    """RMS, and the lines of cage and shaft over it."""
    spectrum, rms = amplitude_spectrum(signal), float(signal.std())
    step = float(spectrum["frequency"][1])
    near = {
        name: float(spectrum.sel(frequency=slice(lines[name] - step, lines[name] + step)).max())
        for name in ("FTF", "2 BSF", "BPFO")
    }
    return {"rms": rms} | {f"at {name}": height / rms for name, height in near.items()}


def judged(table: pd.DataFrame, sensors: Sequence[str], *, shuffle: int | None = None) -> pd.Series:
    """Faults by models that have seen the other half of the bearings; of labels that are shuffled
    among the recordings learnt from, with a seed."""
    columns = [name for name in table.columns if name.split(":")[0] in sensors]
    second = table["bearing"].isin(sorted(table["bearing"].unique())[1::2])
    found = pd.Series("", index=table.index)
    for other in (False, True):
        learnt, judge = table[second == other], table[second != other]
        known = learnt[columns].dropna(axis="columns", how="all")  # short signals lack FTF
        labels = learnt["fault"].to_numpy()
        if shuffle is not None:
            labels = np.random.default_rng(shuffle).permutation(labels)
        model = HistGradientBoostingClassifier(min_samples_leaf=3, random_state=0)
        found[judge.index] = model.fit(known, labels).predict(judge[known.columns])
    return found


def by_bearing(right: pd.Series, bearing: pd.Series) -> tuple[float, float]:
    """95 % interval of the share that is right, by drawing bearings with replacement: recordings of
    one bearing are alike."""
    shares = right.groupby(bearing).mean().to_numpy()
    draws = np.random.default_rng(1).choice(shares, (10_000, len(shares))).mean(axis=1)
    return float(np.quantile(draws, 0.025)), float(np.quantile(draws, 0.975))


def by_class(right: pd.Series, label: pd.Series) -> str:
    """A line a class and severity: share that is right, with Wilson's 95 % interval."""
    lines = []
    for name, own in right.groupby(label, sort=False):
        low, high = wilson(int(own.sum()), len(own))
        lines.append(f"  {name:28} {own.mean():.2f}, {low:.2f} to {high:.2f} of {len(own)}")
    return "\n".join(lines)


def wilson(count: int, of: int, z: float = 1.96) -> tuple[float, float]:
    """95 % interval of a share (E. B. Wilson, J. Am. Stat. Assoc. 22 (1927) 209)."""
    share, more = count / of, z**2 / of
    middle = share + more / 2
    half = z * np.sqrt(share * (1 - share) / of + more / (4 * of))
    return float((middle - half) / (1 + more)), float((middle + half) / (1 + more))


def draw(table: pd.DataFrame, told: dict[str, pd.Series], path: str) -> None:
    """What recordings of each class and severity were taken for."""
    faults, labels = list(dict.fromkeys(table["fault"])), list(dict.fromkeys(table["label"]))
    with sheet.style():
        figure = sheet.new_figure(1500, 250 + 46 * len(labels))
        subtitle = f"{len(table)} recordings, each judged by a model of the other half of bearings"
        sheet.heading(figure, "What gradient boosting takes a fault for", subtitle)
        for i, (name, found) in enumerate(told.items()):
            count = pd.crosstab(table["label"], found).reindex(labels, columns=faults).fillna(0)
            ax = sheet.axes_at(figure, (330 + 590 * i, 140, 540, 46 * len(labels)))
            ax.imshow(count, cmap="Blues", aspect="auto", vmax=1.3 * count.to_numpy().max())
            for (row, column), n in np.ndenumerate(count.to_numpy(int)):
                if n:
                    ax.text(column, row, n, ha="center", va="center")
            short = [
                fault.replace("rolling_element", "ball").replace("+", "\n+ ") for fault in faults
            ]
            ax.set_xticks(range(len(faults)), short)
            ax.set_yticks(range(len(labels)), labels if i == 0 else [""] * len(labels))
            right = (found == table["fault"]).mean()
            ax.set_title(f"{name}: {100 * right:.0f} % right", loc="left")
            ax.grid(False)
        sheet.save(figure, path)


def small(path: Path) -> Path:
    """The study with four bearings, three of the faults, one load and a third of the time."""
    table = tomllib.loads(STUDY.read_text())
    bearings, faults, load, duration = table["axes"]
    bearings["values"] = {key: values[:4] for key, values in bearings["values"].items()}
    faults["points"] = [p for p in faults["points"] if p["label"] in QUICK]
    load["values"], duration["values"] = load["values"][:1], ["80 ms"]
    path.write_text(write_toml({**table, "case": str(STUDY.with_name(table["case"]))}))
    return path


QUICK = ("sound", "outer race, 0.8 mm", "inner race, 0.2 mm")

if __name__ == "__main__":
    where = Path(sys.argv[1] if len(sys.argv) > 1 else "runs/diagnosis")
    found = main(where, "diagnosis.png")
    assert found["casing and cage laser"] > found["shuffled labels"] + 0.3, found
