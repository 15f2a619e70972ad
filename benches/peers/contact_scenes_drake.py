"""The scenes of contact_scenes.py in Drake: SAP with the default compliance of points, gains implicit in its steps.

Where two shapes touch it has one point: the box of the pusher has a small sphere at each corner, and does not touch the
table otherwise.
"""

import logging
import tempfile
import time
from pathlib import Path

import numpy as np
from pydrake.common.eigen_geometry import Quaternion
from pydrake.geometry import CollisionFilterDeclaration, GeometrySet
from pydrake.math import RigidTransform
from pydrake.multibody.parsing import Parser
from pydrake.multibody.plant import AddMultibodyPlantSceneGraph, DiscreteContactApproximation
from pydrake.multibody.tree import PdControllerGains
from pydrake.systems.analysis import Simulator
from pydrake.systems.framework import DiagramBuilder

# It warns of what the MJCF says to MuJoCo alone.
logging.getLogger("drake").setLevel(logging.ERROR)


class Drake:
    name = "Drake, SAP"

    def __init__(self, scene, file, joints):
        self.scene, self.targets = scene, np.array(scene["targets"])
        builder = DiagramBuilder()
        self.plant, graph = AddMultibodyPlantSceneGraph(builder, scene["step"])
        self.plant.set_discrete_contact_approximation(DiscreteContactApproximation.kSap)
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / "scene.xml"
            path.write_text(file)
            Parser(self.plant).AddModels(str(path))
        actuators = [self.plant.get_joint_actuator(k) for k in self.plant.GetJointActuatorIndices()]
        self.joints = [actuator.joint() for actuator in actuators]
        assert [joint.name() for joint in self.joints] == joints, "actuators in another order"
        for actuator, k, d in zip(actuators, scene["stiffness"], scene["damping"]):
            actuator.set_controller_gains(PdControllerGains(p=k, d=d))
        self.plant.Finalize()
        inspector = graph.model_inspector()
        called = {inspector.GetName(k).split("::")[-1]: k for k in inspector.GetAllGeometryIds()}
        if "box" in called:
            box, table = GeometrySet(called["box"]), GeometrySet(called["table"])
            graph.collision_filter_manager().Apply(CollisionFilterDeclaration().ExcludeBetween(box, table))
        self.free = self.plant.get_body(next(iter(self.plant.GetFloatingBaseBodies())))
        self.diagram = builder.Build()
        self.restart()

    def restart(self):
        self.simulator = Simulator(self.diagram)
        self.context = self.plant.GetMyMutableContextFromRoot(self.simulator.get_mutable_context())
        places = self.plant.GetPositions(self.context)
        for joint, place in zip(self.joints, self.scene["joints"]):
            places[joint.position_start()] = place
        self.plant.SetPositions(self.context, places)
        pose = self.scene["pose"]
        turn = np.array(pose[3:]) / np.linalg.norm(pose[3:])
        self.plant.SetFreeBodyPose(self.context, self.free, RigidTransform(Quaternion(turn), pose[:3]))
        self.port = self.plant.get_desired_state_input_port(self.joints[0].model_instance())
        self.lead(self.targets[0])
        self.simulator.Initialize()
        self.steps = 0

    def lead(self, target):
        self.port.FixValue(self.context, np.concatenate([target, np.zeros(len(target))]))

    def advance(self, steps):
        self.steps += steps
        self.simulator.AdvanceTo(self.steps * self.scene["step"])

    def batch(self, number):
        each, held = self.scene["batch"], self.scene["held"]
        before = time.perf_counter()
        for target in self.targets[number * each : (number + 1) * each]:
            self.lead(target)
            self.advance(held)
        return 1e6 * (time.perf_counter() - before) / (each * held)

    def place(self):
        return self.plant.EvalBodyPoseInWorld(self.context, self.free).translation().copy()

    def quality(self):
        self.restart()
        lowest, slips, rested = 0.0, [], None
        seconds = round(1 / (self.scene["step"] * self.scene["held"]))
        for n, target in enumerate(self.targets):
            if n + seconds == len(self.targets):
                rested = self.place()
            self.lead(target)
            for _ in range(self.scene["held"]):
                self.advance(1)
                results = self.plant.get_contact_results_output_port().Eval(self.context)
                for k in range(results.num_point_pair_contacts()):
                    contact = results.point_pair_contact_info(k)
                    lowest = min(lowest, -contact.point_pair().depth)
                    slips.append(contact.slip_speed())
        creep = np.median(slips) if self.scene["sticks"] == "feet" else np.linalg.norm(self.place() - rested)
        way = np.linalg.norm(self.place() - self.scene["pose"][:3])
        return {"lowest": float(lowest), "creep": float(creep), "way": float(way)}
