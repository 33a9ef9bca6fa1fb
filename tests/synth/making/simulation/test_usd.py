"""USD: opened and validated by its own library."""

import numpy as np
import pytest
from simulated import planar_four_bar
from sizes import slow_but

import synth
from synth.making.simulation.assembly import assembly_of


@pytest.mark.parametrize("name", slow_but(("miura", "goldberg"), ["miura", "goldberg", "3-rps", "resch", "crash-lock"]))
def test_stages(name, tmp_path):
    usd = pytest.importorskip("pxr", reason="usd-core is not installed; try make test-simulators")
    from pxr import Usd, UsdPhysics, UsdValidation

    assert usd
    mechanism = synth.generate(name).mechanism
    assembly = assembly_of(mechanism)
    synth.write_model(mechanism, tmp_path / "a.usda", "usd")
    stage = Usd.Stage.Open(str(tmp_path / "a.usda"))
    registry = UsdValidation.ValidationRegistry()
    context = UsdValidation.ValidationContext(registry.GetOrLoadAllValidators())
    assert [error.GetMessage() for error in context.Validate(stage)] == []
    prims = list(stage.Traverse())
    bodies = [prim for prim in prims if prim.HasAPI(UsdPhysics.RigidBodyAPI)]
    assert len(bodies) == len(assembly.bodies)
    masses = [UsdPhysics.MassAPI(prim) for prim in bodies]
    for mass, body in zip(masses, assembly.bodies, strict=True):
        assert mass.GetMassAttr().Get() == pytest.approx(body.properties.mass, rel=1e-6)
        turn = mass.GetPrincipalAxesAttr().Get()
        axes = np.array([turn.Transform(axis) for axis in np.eye(3).tolist()]).T
        inertia = axes @ np.diag(mass.GetDiagonalInertiaAttr().Get()) @ axes.T
        assert np.abs(inertia - body.properties.inertia).max() < 1e-5 * np.abs(body.properties.inertia).max()
    joints = [UsdPhysics.Joint(prim) for prim in prims if prim.IsA(UsdPhysics.Joint)]
    excluded = [joint for joint in joints if joint.GetExcludeFromArticulationAttr().Get()]
    assert len(joints) == len(assembly.hinges) + len(assembly.bases)
    assert len(excluded) == len(assembly.cuts)


@pytest.mark.parametrize("mechanism", [planar_four_bar(), synth.generate("miura").mechanism], ids=["bars", "panels"])
def test_text(mechanism, tmp_path):
    synth.write_model(mechanism, tmp_path / "a.usda", "usd")
    text = (tmp_path / "a.usda").read_text()
    assert text.startswith("#usda 1.0\n")
    assert text.count("{") == text.count("}")
    assembly = assembly_of(mechanism)
    assert text.count("excludeFromArticulation") == len(assembly.cuts)
    assert text.count("PhysicsRigidBodyAPI") == len(assembly.bodies)
    assert text.count("PhysicsDriveAPI") == 1
