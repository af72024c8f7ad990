"""A bearing with a spall as an accelerometer sees it: its envelope shows how often balls pass."""

from pathlib import Path

import flexcage
from flexcage.results.spectra import envelope_spectrum


def main(picture: str = "", **changes: object) -> tuple[float, float]:
    """Strongest line of the envelope's spectrum [Hz], and BPFO by the run's own speeds."""
    case = flexcage.load_case(Path(__file__).with_name("6205_signals.toml"), overrides=changes)
    run = flexcage.simulate(case)
    casing = run.signals["casing"]
    spectrum = envelope_spectrum(casing, (2e3, 20e3))
    line = float(spectrum.sel(frequency=slice(150.0, 600.0)).idxmax("frequency"))
    bpfo = run.signals.attrs["BPFO (Hz)"]
    print(f"strongest line {line:.1f} Hz; BPFO {bpfo:.1f} Hz by the run's own speeds")
    if picture:
        force = run.dataset["race_force"].sel(race="outer")
        lines = {name: run.summary[f"frequency_{key}"] for name, key in KEYS.items()}
        flexcage.render.signal_picture(
            casing, picture, lines=lines, title=case.name,
            force=force.assign_attrs(long_name="force of the outer race on each ball"),
        )  # fmt: skip
    return line, bpfo


KEYS = {"FTF": "ftf", "2 BSF": "bsf_twice", "BPFO": "bpfo", "BPFI": "bpfi"}

if __name__ == "__main__":
    found, expected = main("signals.png")
    assert abs(found - expected) < 10.0, found  # a bin of 0.12 s is 8.3 Hz wide
