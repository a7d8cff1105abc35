"""Lets a robot follow the specification that is approved on a Goalgraph server."""

from .client import Executor, Refused
from .run import Failed, Robot, Run, Unavailable
from .specification import Specification, SubGoal, Tampered

__all__ = ["Executor", "Failed", "Refused", "Robot", "Run", "Specification", "SubGoal", "Tampered", "Unavailable"]
