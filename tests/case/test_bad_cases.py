"""Mistakes in a case: one sentence each, with the place and what would be right."""

import pytest

from flexcage.case import load_case
from flexcage.core.errors import InputError

PRESET = '[bearing]\npreset = "N1013"\n'

BAD = {
    "wrong unit": ('[cage]\nbore = "79 kg"', "cage.bore", ["'79 kg'", "mm"]),
    "no unit": ("[load]\nradial = 1000", "load.radial", ["without a unit", "'1000 N'"]),
    "unit unknown": ('[load]\nradial = "1 kNn"', "load.radial", ["'kNn'"]),
    "hertz for a speed": (
        '[drive]\nspeed = "100 Hz"',
        "drive.speed",
        ["'100 rev/s'", "'100 rad/s'"],
    ),
    "unknown key": ('[cage]\npocket_widht = "8 mm"', "cage.pocket_widht", ["'pocket_width'"]),
    "unknown section": ("[lubrication]\n", "lubrication", ["'lubricant'"]),
    "deep unknown key": (
        "[contacts.pocket.friction]\nstatc = 0.1",
        "contacts.pocket.friction.statc",
        ["[contacts.pocket.friction]", "'static'"],
    ),
    "not a choice": ('[cage]\nguidance = "ouetr"', "cage.guidance", ["'outer'"]),
    "not a model": ('[cage]\nmodel = "elastic"', "cage.model", ["cage.model 'elastic'", "rigid"]),
    "not a material": ('[cage]\nmaterial = "bras"', "cage.material", ["'brass'"]),
    "not a ratio": ("[modes]\nratios = [0.01, 2]", "modes.ratios", ["is 2", "1 or less"]),
    "not a bound": ("[modes]\ndamping = 2", "modes.damping", ["is 2", "1 or less"]),
    "defect without type": ("[[defects]]\ncrossbeam = 5", "defects.0.type", ["crossbeam"]),
    "defect of another type": ('[[defects]]\ntype = "crosbeam"', "defects.0.type", ["'crossbeam'"]),
    "defect incomplete": (
        '[[defects]]\ntype = "crossbeam"\ncrossbeam = 5',
        "defects.0.displacement",
        ["lacks 'displacement'", "delta_q"],
    ),
    "defect not there": (
        '[[defects]]\ntype = "crossbeam"\ncrossbeam = 22\ndisplacement = "0.1 mm"',
        "defects.0.crossbeam",
        ["22", "0 to 21"],
    ),
    "defects as a table": ('[defects]\ntype = "crossbeam"', "defects", ["a list"]),
    "material unnamed": (
        '[cage]\nmaterial = {name = "tin", density = "7.3 g/cm^3"}',
        "cage.material.youngs_modulus",
        ["lacks 'youngs_modulus'", "GPa"],
    ),
    "density in other units": (
        '[cage]\nmaterial = {name = "brass", density = "8.5e-9 kg/m^3"}',
        "cage.material.density",
        ["is 8.5e-09 kg/m^3, far below", "steel has 7850"],
    ),
    "negative clearance": ('[cage]\npocket_width = "7.9 mm"', "cage.pocket_width", ["-0.1 mm"]),
    "table and speeds differ": (
        '[drive]\ntimes = ["0 s", "1 s"]\nspeeds = ["0 rpm"]',
        "drive.times",
        ["2 entries", "speeds 1"],
    ),
    "times fall": (
        '[load]\ntimes = ["1 s", "0 s"]\nvalues = ["0 N", "1 N"]',
        "load.times",
        ["must rise"],
    ),
    "tilt free on nothing": (
        '[load]\ntilt = "free"',
        "load.tilt",
        ["nothing in the motion", "load.tilt_stiffness", "'held'"],
    ),
    "axial load on nothing": (
        '[load]\naxial = "5 N"',
        "load.axial",
        ["the design N has ribs on the inner ring alone", "NUP", "load.axial_stiffness"],
    ),
    "moment on nothing": (
        '[load]\nmoment_y = "5 N*m"',
        "load.moment_y",
        ["tilts are held", "load.tilt_stiffness", "static"],
    ),
    "axial wave on nothing": (
        '[load]\nwave = "sine"\nwave_of = "axial"',
        "load.wave_of",
        ["axial motion is held", "load.axial_stiffness"],
    ),
    "stiffness of a tilt that is held": (
        '[load]\ntilt_stiffness = "1000 N*m/rad"',
        "load.tilt_stiffness",
        ["1000 N*m/rad", 'load.tilt = "free"'],
    ),
    "damper without a spring": (
        '[load]\naxial_damping = "10 N*s/m"',
        "load.axial_damping",
        ["10 N*s/m", "load.axial_stiffness"],
    ),
    "shaft too soft": (
        '[load]\naxial = "1 kN"\naxial_stiffness = "0.1 N/um"',
        "load.axial_stiffness",
        ["1000 N", "off the outer race", "0.2 N/um"],
    ),
    "negative stiffness": (
        '[load]\naxial_stiffness = "-1 N/um"',
        "load.axial_stiffness",
        ["0 N/m or more"],
    ),
    "ramp without time": ('[drive]\nramp_to = "1 rpm"', "drive.ramp_time", ["how long"]),
    "ramp by time and acceleration": (
        '[drive]\nramp_to = "1 rpm"\nramp_time = "1 s"\nacceleration = "5 rad/s^2"',
        "drive.acceleration",
        ["drive.ramp_time", "keep one"],
    ),
    "acceleration to nowhere": (
        '[drive]\nacceleration = "5 rad/s^2"',
        "drive.ramp_to",
        ["drive.acceleration is given", "give drive.ramp_to"],
    ),
    "acceleration as a length": (
        '[drive]\nramp_to = "1 rpm"\nacceleration = "5 m/s^2"',
        "drive.acceleration",
        ["another kind", "rad/s^2"],
    ),
    "no acceleration": (
        '[drive]\nramp_to = "1 rpm"\nacceleration = "0 rad/s^2"',
        "drive.acceleration",
        ["greater than 0"],
    ),
    "axial ramp where none is borne": (
        '[load]\nvaries = "axial"\nramp_to = "1 N"\nramp_time = "1 s"',
        "load.ramp_to",
        ["the design N", "carries no axial load", "NUP"],
    ),
    "axial table where none is borne": (
        '[load]\nvaries = "axial"\ntimes = ["0 s", "1 s"]\nvalues = ["0 N", "1 N"]',
        "load.values",
        ["load.values makes the axial load 1 N", "carries no axial load"],
    ),
    "varies in no direction": ('[load]\nvaries = "axail"', "load.varies", ["'axial'"]),
    "overload by a wave": (
        '[load]\nwave = "sine"\nwave_period = "9 ms"\nwave_amplitude = "800 kN"',
        "load.wave_amplitude",
        ["800 kN", "51 kN"],
    ),
    "decimal comma": ('[load]\nradial = "1,5 kN"', "load.radial", ["with a point", "'1.5 kN'"]),
    "held by another method": (
        '[load]\ncentre = "held"\n[solver]\nmethod = "bdf"',
        "load.centre",
        ["'held'", 'solver.method = "explicit"', "'bdf'"],
    ),
    "held under a wave": (
        '[load]\ncentre = "held"\nwave = "sine"\nwave_period = "1 ms"\nwave_amplitude = "1 N"\n'
        '[solver]\nmethod = "explicit"',
        "load.wave",
        ["'sine'", "cannot vary", "leave it out"],
    ),
    "fillets as large as pockets": (
        '[cage]\nfillet_radius = "3 mm"',
        "cage.fillet_radius",
        ["3 mm", "0.93861 mm inside the fillets", "smaller"],
    ),
    "unbalance of a flywheel": (
        '[cage]\nunbalance = "100000 g*mm"',
        "cage.unbalance",
        ["100000 g*mm", "no more than"],
    ),
    "overload": ('[load]\nradial = "800 kN"', "load.radial", ["800 kN", "51 kN"]),
    "overload of a few ratings": (
        '[load]\nradial = "500 kN"',
        "load.radial",
        ["500 kN", "4 times", "51 kN"],
    ),
    "clearance of a hand": (
        '[bearing]\nradial_clearance = "5 mm"',
        "bearing.radial_clearance",
        ["5 mm", "one roller alone", "0.4 mm"],
    ),
    "rollers of any size": (
        '[bearing]\nroller_scatter = "1 mm"',
        "bearing.roller_scatter",
        ["1 mm", "0.08 mm"],
    ),
    "tilt of a fan": (
        '[load]\nmisalignment = "200 mrad"',
        "load.misalignment",
        ["200 mrad", "1 %", "21.9 mrad"],
    ),
    "speed of a drill": (
        '[drive]\nspeed = "6000000 rpm"',
        "drive.speed",
        ["centrifugal", "every roller", "399000 rpm"],
    ),
    "speed at a ramp's end": (
        '[drive]\nramp_to = "500000 rpm"\nramp_time = "1 s"',
        "drive.ramp_to",
        ["500000 rpm", "centrifugal"],
    ),
    "cage wider than its bearing": ('[cage]\nwidth = "30 mm"', "cage.width", ["30 mm", "18 mm"]),
    "tiny elements": ('[mesh]\nsize = "1 um"', "mesh.size", ["0.001 mm", "elements"]),
    "coarse elements": ('[mesh]\nsize = "9 mm"', "mesh.size", ["9 mm", "3.58", "twice"]),
    "tiny fillets": ('[mesh]\nfillet_size = "1 um"', "mesh.fillet_size", ["elements"]),
    "endless": ('[solver]\nduration = "inf s"', "solver.duration", ["infinite"]),
    "endless table": (
        '[load]\ntimes = ["0 s", "inf s"]\nvalues = ["0 N", "1 N"]',
        "load.times",
        ["infinite"],
    ),
    "no sample": ('[solver]\nduration = "1 us"', "solver.duration", ["1 us", "40 us"]),
    "no slices": ("[contacts.pocket]\nslices = 0", "contacts.pocket.slices", ["is 0", "3 or"]),
    "no modes": ("[modes]\ncount = 0", "modes.count", ["is 0", "1 or more"]),
    "no tolerance": ('[solver]\ntolerance = "0 um"', "solver.tolerance", ["greater than"]),
    "below rounding": ('[solver]\ntolerance = "1e-9 um"', "solver.tolerance", ["rounding"]),
    "coarser than contacts": ('[solver]\ntolerance = "2 um"', "solver.tolerance", ["2 um", "1 um"]),
    "newton loose": ("[solver]\nnewton_tolerance = 2", "solver.newton_tolerance", ["1 or less"]),
    "newton": ("[solver]\nnewton_tolerance = 0", "solver.newton_tolerance", ["0.001 or more"]),
    "newton fine": ("[solver]\nnewton_tolerance = 1e-30", "solver.newton_tolerance", ["1e-30"]),
    "steps": ('[solver]\nmin_step = "60 us"', "solver.min_step", ["60 us", "50 us"]),
    "friction speeds": (
        '[contacts.rib.friction]\nv_static = "2 m/s"',
        "contacts.rib.friction.v_dynamic",
        ["1 m/s", "2 m/s"],
    ),
    "land moved": (
        '[contacts.land]\nclearance = "0.25 mm"\n[cage]\nbore = "79 mm"',
        "contacts.land.clearance",
        ["0.25 mm", "leave 0.3 mm; leave it out"],
    ),
    "land wider than a side beam": (
        '[contacts.land]\nwidth = "30 mm"',
        "contacts.land.width",
        ["is 30 mm", "over 3.875 mm only"],
    ),
    "guided by no land": (
        '[cage]\nguidance = "inner"\n[contacts.land]\nkind = "none"',
        "contacts.land.kind",
        ["inner", "dry"],
    ),
    "output grid": ('[output]\nrate = "70 kHz"', "output.vibration_rate", ["whole", "multiple"]),
}


def with_preset(text):
    """The mistake in a case of the preset; one in [bearing] stands beside the preset's name."""
    if text.startswith("[bearing]\n"):
        return PRESET + text.removeprefix("[bearing]\n") + "\n"
    return PRESET + text + "\n"


@pytest.mark.parametrize("name", BAD)
def test_mistake_is_one_sentence(name):
    text, where, words = BAD[name]
    with pytest.raises(InputError) as caught:
        load_case(with_preset(text))
    sentence = str(caught.value)
    assert caught.value.where == where, sentence
    assert sentence.endswith(".") and "\n" not in sentence
    assert all(word in sentence for word in words), sentence
    assert caught.value.exit_code == 2


NUP = 'design = "NUP"\nrib_diameter = "86.8 mm"\ncounter_rib_diameter = "78.4 mm"\n'
BALLS = '[bearing]\npreset = "7010C-PI"\n[load]\naxial = "100 N"\n'
OVERLOADS = {
    "wave": ('wave = "sine"\nwave_of = "axial"\nwave_period = "9 ms"\nwave_amplitude = "500 kN"',
             "load.wave_amplitude"),
    "ramp": ('varies = "axial"\nramp_to = "-500 kN"\nramp_time = "9 ms"', "load.ramp_to"),
    "table": ('varies = "axial"\ntimes = ["0 s", "9 s"]\nvalues = ["0 N", "-500 kN"]',
              "load.values"),
}  # fmt: skip


@pytest.mark.parametrize("name", OVERLOADS)
def test_axial_loads_that_change_have_a_limit_too(name):
    text, where = OVERLOADS[name]
    with pytest.raises(InputError, match=f"{where} is 500 kN.*static rating") as caught:
        load_case(BALLS + text + "\n")
    assert caught.value.where == where


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("name = \n", ["not valid TOML", "line 1"]),
        (
            '[bearing]\npreset = "N1014"',
            ["'N1014' is not known", "presets are", "N1013", "dimensions"],
        ),
        (
            '[bearing]\nbore = "65 mm"',
            ["[bearing] lacks 'outside_diameter'", "'width'", "'roller_count'", "and 'rib_gap'"],
        ),
        (
            '[bearing]\ntype = "deep_groove_ball"\nball_count = 8',
            ["'bore' (bearing bore d, in mm)", "'ball_diameter'", "'outer_groove_radius'"],
        ),
        ("name = 'x'\n", ["lacks 'bearing' (the bearing); give it"]),
        (
            '[bearing]\npreset = "NU1013"',
            ["presets are", "'flexcage new NU1013' writes such a case, from your maker's ratings"],
        ),
        ('[bearing]\npreset = "nj 205 ECP"', ["presets are", "give bearing.design"]),
        ('[bearing]\ntype = "NU"', ["give bearing.design (type 'cylindrical_roller')"]),
        (
            '[bearing]\ntype = "NCF"',
            ["single-row: give", 'a full complement has model = "none" in [cage]'],
        ),
        (
            '[bearing]\ntype = "toroidal"',
            ["cylindrical_roller", "angular_contact_ball, deep_groove_ball"],
        ),
        (PRESET + 'design = "NP"', ["bearing.design 'NP' is not known", "NU"]),
        (PRESET + 'outer_rib_diameter = "90 mm"', ["bearing.design says which ring has ribs"]),
        (
            PRESET + 'design = "NUP"',
            ["counter_rib_diameter is missing", "the design NUP has ribs on the inner ring too"],
        ),
        (
            PRESET + 'design = "NJ"\ncounter_rib_diameter = "78.4 mm"\nrib_diameter = "86.8 mm"',
            ["counter_rib_gap is missing", "the design NJ has a rib on the inner ring too"],
        ),
        (
            PRESET + 'counter_rib_gap = "8.03 mm"',
            ["is 8.03 mm, but the design N has no ribs on the outer ring", "NJ, NUP or NF"],
        ),
        (
            PRESET + NUP + 'counter_rib_gap = "8 mm"',
            ["counter_rib_gap is 8 mm", "the roller's length, 8 mm"],
        ),
        (
            PRESET + NUP + 'counter_rib_gap = "18 mm"',
            ["counter_rib_gap is 18 mm, which leaves no ribs"],
        ),
        (
            PRESET + NUP.replace("78.4", "87") + 'counter_rib_gap = "8.03 mm"',
            ["rib_diameter is 86.8 mm, but must be greater than counter_rib_diameter, 87 mm"],
        ),
        (
            PRESET + 'design = "NU"\nrib_diameter = "86.5 mm"',
            ["the cage cuts through the outer ring's ribs, 86.5 mm"],
        ),
        (
            PRESET + NUP.replace("78.4", "79") + 'counter_rib_gap = "8.03 mm"',
            ["cage.bore is 78.9 mm, so the cage cuts through the inner ring's ribs, 79 mm"],
        ),
        (
            PRESET + NUP.replace("NUP", "NJ") + 'counter_rib_gap = "8.03 mm"\n'
            '[cage]\nguidance = "inner"',
            ["the design NJ has a rib on one side alone", "take 'roller' or 'outer'"],
        ),
        (
            PRESET + '[load]\naxial = "100 N"',
            ["load.axial is 100 N", "the design N has ribs on the inner ring alone", "NJ", "NUP"],
        ),
        (
            PRESET + NUP.replace("NUP", "NJ") + 'counter_rib_gap = "8.03 mm"\n'
            '[load]\naxial = "-100 N"',
            ["this NJ carries axial load towards +x alone", 'bearing.thrust = "-x"'],
        ),
        (
            PRESET + NUP.replace("NUP", "NJ") + 'counter_rib_gap = "8.03 mm"\n[load]\n'
            'axial = "100 N"\nvaries = "axial"\nramp_to = "-10 N"\nramp_time = "1 ms"',
            ["load.ramp_to makes the axial load -10 N", "towards +x alone"],
        ),
        (PRESET + '[[defects]]\ntype = "spall"', ["[bearing.outer_spall]"]),
        (
            '[bearing]\npreset = "7603025"\nspall = "1 mm"',
            ["'spall'", "[bearing.outer_spall] or [bearing.inner_spall]"],
        ),
        ("name = ''\n[bearing]\npreset = 'N1013'", ["name is ''", "folder"]),
        ("name = '../up'\n[bearing]\npreset = 'N1013'", ["'../up'", "without '/'"]),
        ("bearing = 3\n", ["bearing is 3", "a table"]),
        ('[bearing]\npreset = "N1013"\nroller_count = 40', ["40 rollers", "at most 32"]),
    ],
)
def test_case_that_is_no_case(text, words):
    with pytest.raises(InputError) as caught:
        load_case(text)
    assert all(word in str(caught.value) for word in words), str(caught.value)


def test_files_that_cannot_be_read(tmp_path):
    (tmp_path / "binary.toml").write_bytes(b"\xff\xfe\x00")
    for path, words in (
        (tmp_path / "none.toml", "no case file"),
        (tmp_path, "is a folder"),
        (tmp_path / "binary.toml", "not a text file"),
    ):
        with pytest.raises(InputError, match=words):
            load_case(path)


@pytest.mark.parametrize("coding", ["utf-16", "utf-16-le", "utf-16-be", "latin-1"])
def test_text_in_another_encoding_is_told_how_to_save_it(tmp_path, coding):
    file = tmp_path / "case.toml"
    file.write_bytes(f'{PRESET}\n[drive]\nspeed = "6000 rpm" # Prüfung\n'.encode(coding))
    with pytest.raises(InputError, match="in UTF-8: save the file again") as caught:
        load_case(file)
    said = "is text in UTF-16" if coding != "latin-1" else "its line "
    assert said in str(caught.value) and str(caught.value).count("case.toml") == 1
    assert str(caught.value).endswith("'Save as'.")


def test_a_byte_order_mark_is_no_mistake(tmp_path):
    (tmp_path / "case.toml").write_text(PRESET, encoding="utf-8-sig")
    assert load_case(tmp_path / "case.toml").preset == "N1013"


BEAM = '[[defects]]\ntype = "crossbeam"\ncrossbeam = 3\ndisplacement = "0.1 mm"\n'
SIDE = '[[defects]]\ntype = "side_beam"\npocket = 9\ndisplacement = "0.1 mm"\n'
LONG = '[[defects]]\ntype = "elongated"\npocket = 3\ndirection = "axial"\nelongation = "0.1 mm"\n'
SAME = "defects.1 is the same as defects.0, and both would add up; leave one out."


@pytest.mark.parametrize(
    ("text", "sentence"),
    [
        (PRESET + BEAM + BEAM, "Crossbeam 3 is bent 2 times; give one"),
        (PRESET + BEAM + BEAM.replace("0.1", "0.2"), "Crossbeam 3 is bent 2 times; give one"),
        (PRESET + SIDE + SIDE.replace("0.1", "0.2"), "The side beam +x of pocket 9 is displaced 2"),
        (BALLS + LONG + LONG, SAME),
    ],
)
def test_a_defect_that_stands_twice_is_refused(text, sentence):
    """Both would be added, and the cage have twice what each says."""
    with pytest.raises(InputError) as caught:
        load_case(text)
    assert sentence in str(caught.value)


def test_defects_of_one_beam_that_differ_in_kind_may_add_up():
    case = load_case(PRESET + BEAM + BEAM + 'shape = "shifted"\n' + BEAM.replace("= 3", "= 4"))
    assert len(case.defects) == 3
