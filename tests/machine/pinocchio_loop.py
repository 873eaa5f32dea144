"""The Jacobian of a structural loop by an independent library, pinocchio, and topologies to compare on."""

from __future__ import annotations

import numpy as np
import pinocchio as pin

from elastogeo.machine import COMPONENTS, Array, Machine

TOPOLOGIES = (
    *("wFYXt", "wXYFt", "wXFYt", "wCAFYXZSt", "wCAYfXZt", "wFXYZBCt", "wXFYZBCt", "wCBXFYZt", "wAFXYZBt", "wBXFZYt"),
    *("wZFXYCt", "wABCXYZUVWFt", "wFZWVUYXCBASt", "wSCFt"),
)
PIN_JOINTS = (
    dict.fromkeys("XU", pin.JointModelPX)
    | dict.fromkeys("YV", pin.JointModelPY)
    | dict.fromkeys("ZW", pin.JointModelPZ)
    | {"A": pin.JointModelRX, "B": pin.JointModelRY, "C": pin.JointModelRZ, "S": pin.JointModelRZ}
)


def pinocchio_jacobian(machine: Machine, commands: Array) -> tuple[Array, Array]:
    """Jacobian (6, 6 n) and tool point, from pinocchio: after each joint six virtual ones, X Y Z A B C, at rest."""
    model = pin.Model()
    ends, first = {}, {}
    for branch, side in ((reversed(machine.topology.workpiece), -1), (iter(machine.topology.tool), 1)):
        parent = 0
        for axis in branch:
            joint = machine.joints[machine.index(axis)]
            placement = pin.SE3(pin.exp3(np.array(joint.tilt)), np.array(joint.offset))
            parent = model.addJoint(parent, PIN_JOINTS[axis](), placement, axis)
            first[axis] = model.joints[parent].idx_q + 1
            for component in COMPONENTS:
                parent = model.addJoint(parent, PIN_JOINTS[component](), pin.SE3.Identity(), f"{axis}{component}")
        ends[side] = parent
    q = np.zeros(model.nq)
    for axis, command in zip(machine.axes, commands, strict=True):
        q[first[axis] - 1] = command if machine.in_tool_branch(axis) else -command
    data = model.createData()
    pin.computeJointJacobians(model, data, q)
    tool = data.oMi[ends[1]].act(np.array(machine.tool))
    about_ground = {side: pin.getJointJacobian(model, data, ends[side], pin.ReferenceFrame.WORLD) for side in ends}
    at_tool = pin.SE3(np.eye(3), -tool).toActionMatrix()
    blocks = []
    for axis in machine.axes:
        side = 1 if machine.in_tool_branch(axis) else -1
        blocks.append(side * (at_tool @ about_ground[side])[:, first[axis] : first[axis] + 6])
    return np.hstack(blocks), tool
