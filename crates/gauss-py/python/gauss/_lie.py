"""Rigid motions as matrices of four rows, `[[R, p], [0, 1]]`, as `pose` gives them, and twists (linear, angular)."""

import numpy as np

from . import _native
from ._calls import numbers


def _poses(name, value):
    poses = numbers(name, value)
    if poses.shape[-2:] != (4, 4):
        raise ValueError(f"{name} has shape {poses.shape}; expected (..., 4, 4)")
    turns = poses[..., :3, :3]
    # As rotations of q are refused: in more than half of the digits.
    off = np.abs(turns @ np.swapaxes(turns, -1, -2) - np.eye(3)).max(initial=0.0)
    if not (off <= 2 * np.sqrt(np.finfo(float).eps) and (np.linalg.det(turns) > 0).all()):
        raise ValueError(f"{name} is no rigid motion: R R^T differs from 1 by {off:.2g}, or R reflects")
    return poses


def exp6(increment):
    """The motion (..., 4, 4) to which a body comes within a second at the twist (..., 6), in its own axes, in m/s and
    rad/s: `retract` of a pose, from that of the observer."""
    increment = numbers("increment", increment)
    if increment.shape[-1:] != (6,):
        raise ValueError(f"increment has shape {increment.shape}; expected (..., 6)")
    return _native.exp6(increment.reshape(-1, 6)).reshape(increment.shape[:-1] + (4, 4))


def log6(pose):
    """The twist (..., 6) by which a body comes to the motion (..., 4, 4) within a second, with the angle at most pi:
    the inverse of `exp6`."""
    pose = _poses("pose", pose)
    return _native.log6(pose.reshape(-1, 16)).reshape(pose.shape[:-2] + (6,))


def turned(pose):
    """The matrix (..., 6, 6) that turns components of twists and Jacobians from axes of a frame to the observer's; the
    pole stays the frame's origin: `turned(pose) @ jacobian` is what Pinocchio calls LOCAL_WORLD_ALIGNED."""
    turns = _poses("pose", pose)[..., :3, :3]
    zero = np.zeros_like(turns)
    return np.block([[turns, zero], [zero, turns]])


def adjoint(pose):
    """The matrix (..., 6, 6) that turns components of twists and Jacobians from axes of a frame to the observer's, and
    moves the pole to the observer's origin: `adjoint(pose) @ jacobian` is what Pinocchio calls WORLD."""
    matrix = turned(pose)
    x, y, z = np.moveaxis(np.asarray(pose, float)[..., :3, 3], -1, 0)
    zero = np.zeros_like(x)
    cross = np.stack([np.stack(row, -1) for row in ([zero, -z, y], [z, zero, -x], [-y, x, zero])], -2)
    matrix[..., :3, 3:] = cross @ matrix[..., 3:, 3:]
    return matrix
