"""The robots of contact_steps.py in Drake: `pip install drake mujoco && python benches/peers/contact_steps_drake.py`.

The same files, feet, gains, friction and steps of a millisecond, by its discrete steps: SAP, a convex relaxation of
Coulomb's law, with the default compliance of points (Castro et al. 2022), and its `lagged` approximation of Coulomb's
law. Gains are implicit in its steps, as its own controllers are. Times are of `Simulator.AdvanceTo` in batches of 100
steps. The feet are those of the last of three seconds.
"""

import logging
import sys
import tempfile
import time
from importlib.metadata import version
from pathlib import Path

import numpy as np
from pydrake.multibody.parsing import Parser
from pydrake.multibody.plant import AddMultibodyPlantSceneGraph, DiscreteContactApproximation
from pydrake.multibody.tree import PdControllerGains
from pydrake.systems.analysis import Simulator
from pydrake.systems.framework import DiagramBuilder

from contact_steps import BATCH, COUNT, STEP, anymal, scene, talos


def stand(name, feet, height, gains, angles, approximation):
    builder = DiagramBuilder()
    plant, graph = AddMultibodyPlantSceneGraph(builder, STEP)
    plant.set_discrete_contact_approximation(approximation)
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder) / f"{name}.xml"
        file.write_text(scene(name, feet, height, gains, False))
        Parser(plant).AddModels(str(file))
    for k, index in enumerate(plant.GetJointActuatorIndices()):
        plant.get_joint_actuator(index).set_controller_gains(PdControllerGains(p=gains(k)[0], d=gains(k)[1]))
    plant.Finalize()
    inspector = graph.model_inspector()
    base = next(plant.get_body(k) for k in plant.GetFloatingBaseBodies())
    touching = [
        (plant.GetBodyFromFrameId(inspector.GetFrameId(k)), inspector.GetPoseInFrame(k).translation(), inspector.GetShape(k))
        for k in inspector.GetAllGeometryIds()
        if type(inspector.GetShape(k)).__name__ == "Sphere" and inspector.GetProximityProperties(k) is not None
    ]
    diagram = builder.Build()
    simulator = Simulator(diagram)
    context = plant.GetMyMutableContextFromRoot(simulator.get_mutable_context())
    model = plant.GetModelInstanceByName(plant.GetModelInstanceName(base.model_instance()))
    held = [plant.get_joint_actuator(k).joint() for k in plant.GetJointActuatorIndices()]
    for joint, angle in zip(held, angles):
        joint.set_angle(context, angle)

    def places():
        poses = [plant.EvalBodyPoseInWorld(context, body).multiply(at) for body, at, _ in touching]
        return np.array(poses)

    pose = plant.GetFreeBodyPose(context, base)
    pose.set_translation(pose.translation() - [0, 0, min(p[2] - s.radius() for p, (_, _, s) in zip(places(), touching))])
    plant.SetFreeBodyPose(context, base, pose)
    port = plant.get_desired_state_input_port(model)
    port.FixValue(context, np.concatenate([angles, np.zeros(len(angles))]))
    simulator.Initialize()
    times, start, lowest = [], None, 0.0
    for batch in range(COUNT // BATCH):
        if batch * BATCH == 2 * COUNT // 3:
            start = places()
        before = time.perf_counter()
        simulator.AdvanceTo((batch + 1) * BATCH * STEP)
        times.append(1e6 * (time.perf_counter() - before) / BATCH)
        if start is not None:
            lowest = min(lowest, *(p[2] - s.radius() for p, (_, _, s) in zip(places(), touching)))
    way = np.abs(places() - start).max()
    low, half, high = np.percentile(times, [25, 50, 75])
    height = plant.EvalBodyPoseInWorld(context, base).translation()[2]
    print(
        f"{name}, {approximation.name}: {half:.1f} µs a step ({low:.1f} to {high:.1f}); lowest gap {lowest:.0e} m, feet "
        f"move {way:.0e} m in a second; {len(touching)} spheres, base at {height:.3f} m"
    )


if __name__ == "__main__":
    logging.getLogger("drake").setLevel(logging.ERROR)
    print(f"Drake {version('drake')}, {sys.version.split()[0]}")
    for approximation in [DiscreteContactApproximation.kSap, DiscreteContactApproximation.kLagged]:
        anymal(stand, approximation=approximation)
        talos(stand, approximation=approximation)
