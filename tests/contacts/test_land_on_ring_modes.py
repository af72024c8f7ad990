"""Lands of a cage in an outer ring whose section is displaced by waves round it."""

import numpy as np
import pytest
from contact_kernels import land
from scipy.spatial.transform import Rotation

from flexcage.contacts import laws
from flexcage.contacts.evaluation import DAMPED, RUBBED, SHEARED, STORED
from flexcage.contacts.ring_waves import COSINE, PLACE, RADIALLY, RATE, SINE
from flexcage.contacts.spec import Contacts, FrictionLaw, LandSpec, NormalLaw

RUBS = FrictionLaw(static=0.1, dynamic=0.06)


@pytest.fixture(scope="module", params=("dry", "film"))
def guided(request, build_parts):
    """A rigid cage that rides on its outer ring."""
    spec = LandSpec(kind=request.param, normal=NormalLaw(restitution=0.6), friction=RUBS)
    return build_parts(cage={"guidance": "outer"}, contacts=Contacts(land=spec)).land


def waving(data, waves):
    """The land in a ring with crests (N + 1, 2, 2, 3)."""
    crest = np.array(waves, float)
    return data._replace(crest=crest, borne=np.zeros(crest[:, :, 0].shape))


def moved(y, z, vy=0.0, vz=0.0):
    """Waves of a ring that is displaced as a whole."""
    crest = np.zeros((2, 2, 2, 3))
    crest[1, COSINE, :, RADIALLY], crest[1, SINE, :, RADIALLY] = (y, vy), (z, vz)
    return crest


def test_a_ring_that_moves_as_a_whole_is_met_where_it_is(guided):
    """To second order of its displacement over the radius, against a rigid ring at that place; the
    rate of its rotation, which waves do not have, makes a dry land rub differently: it stands."""
    data = guided
    shift, speed = np.array([0.0, 3e-6, -2e-6]), np.array([0.0, 2e-3, 1e-3])
    Rc = (data.clearance * (1.02 if data.kind == 1 else 0.6)) * np.array([0.0, 0.8, 0.6])
    call = {"Vc": np.array([0.0, 0.03, -0.02]), "w": np.array([283.0, 0.0, 0.0])}
    call["law"] = laws.restitution
    rigid = land(data, Rc, Rr=shift, Vr=speed, **call)
    waves = waving(data, moved(*shift[1:], *speed[1:]))
    found = land(waves, Rc, **call)
    size = np.abs(rigid[0]).max()
    assert size > 1e-3
    np.testing.assert_allclose(found[0], rigid[0], atol=2e-3 * size)
    borne = [waves.borne[1, quarter, RADIALLY] for quarter in (COSINE, SINE)]
    np.testing.assert_allclose(borne, rigid[3][1:], atol=2e-3 * size)


def bent(rng, size):
    """Waves up to n = 3, in tilt as well."""
    crest = rng.standard_normal((4, 2, 2, 3)) * np.array([1.0, 1.0, 100.0])
    crest[0, SINE] = 0.0
    crest[:, :, RATE] *= 1e3
    return size * crest


def test_a_dry_land_in_a_ring_that_bends_is_elastic_and_keeps_its_power(guided):
    """Forces on cage and waves are slopes of the energy; power is what is damped and rubbed."""
    if guided.kind != 1:
        pytest.skip("a film stores nothing")
    rng = np.random.default_rng(4)
    A = Rotation.from_rotvec([0.02, 2e-4, -3e-4]).as_matrix()
    Rc = (guided.clearance + 12e-6) * np.array([0.0, 0.8, 0.6])
    crest = bent(rng, 1e-6)
    Vc, w = np.array([0.01, 0.04, 0.02]), np.array([283.0, 0.4, -0.3])

    def energy(R=Rc, waves=crest, turn=(0.0, 0.0, 0.0)):
        turned = Rotation.from_rotvec(turn).as_matrix() @ A
        return land(waving(guided, waves), R, A=turned)[5][STORED]

    data = waving(guided, crest * np.array([1.0, 0.0])[:, None])
    Fc, Mc = land(data, Rc, A=A)[:2]
    size = np.abs(Fc).max()
    assert size > 100.0
    for j in (1, 2):
        e = 1e-10 * np.eye(3)[j]
        slope = -(energy(Rc + e) - energy(Rc - e)) / 2e-10
        assert slope == pytest.approx(Fc[j], abs=1e-4 * size)
        e = 1e-8 * np.eye(3)[j]
        slope = -(energy(turn=e) - energy(turn=-e)) / 2e-8
        assert slope == pytest.approx(Mc[j], abs=1e-4 * np.abs(Mc).max())
    for n, quarter in ((0, COSINE), (1, SINE), (2, COSINE), (3, SINE)):
        for c, h in ((RADIALLY, 1e-10), (2, 1e-8)):
            e = np.zeros_like(crest)
            e[n, quarter, PLACE, c] = h
            slope = -(energy(waves=crest + e) - energy(waves=crest - e)) / (2.0 * h)
            assert slope == pytest.approx(data.borne[n, quarter, c], abs=1e-4 * size * 1e-10 / h)
    data = waving(guided, crest)
    call = {"law": laws.restitution, "friction": laws.step_coulomb}
    Fc, Mc, _, _, _, sums = land(data, Rc, A=A, Vc=Vc, w=w, **call)
    rates = crest[:, :, RATE]
    power = Fc @ Vc + Mc @ w + (data.borne * rates).sum()
    h = 1e-9
    ahead = [
        energy(Rc + s * Vc, crest + s * rates[:, :, None] * np.array([[1.0], [0.0]]), s * w)
        for s in (h, -h)
    ]
    stored = (ahead[0] - ahead[1]) / (2.0 * h)
    assert sums[DAMPED] < 0.0 and sums[RUBBED] < -1.0
    scale = abs(stored) + abs(sums[DAMPED]) + abs(sums[RUBBED])
    assert power == pytest.approx(sums[DAMPED] + sums[RUBBED] - stored, abs=1e-4 * scale)


def test_a_film_loses_what_cage_and_ring_give_it(guided):
    if guided.kind == 1:
        pytest.skip("dry")
    data = waving(guided, bent(np.random.default_rng(5), 1e-7))
    Rc, Vc, w = np.array([0.0, 9e-5, 4e-5]), np.array([0.0, 0.03, 0.05]), np.array([283.0, 2.0, -3])
    Fc, Mc, _, _, _, sums = land(data, Rc, Vc=Vc, w=w)
    power = Fc @ Vc + Mc @ w + (data.borne * data.crest[:, :, RATE]).sum()
    assert power == pytest.approx(sums[SHEARED], rel=1e-6)
    assert np.abs(data.borne).max() > 1e-4
