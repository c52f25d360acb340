"""The controller that a bundle is made for."""

from footwork.controllers.state_steering import StateSteering
from footwork.controllers.steering import SteeringController
from footwork.motion.bundle import Bundle
from footwork.motion.table import PolicyTable

STEERING = "steering"


def bundle_controller(
    bundle: Bundle, *, table: PolicyTable | None = None, exact_facing: bool = True
) -> SteeringController:
    """Steering, through the states of an annotated graph where it is one.

    Args:
        bundle: the graph and its states.
        table: what decides; the bundle's own where not given.
        exact_facing: as of SteeringController.

    Raises:
        InputError: for a bundle without a converged steering table where none is given.
    """
    table = table or bundle.table(STEERING)
    if bundle.annotation is None:
        return SteeringController(bundle.graph, table, exact_facing=exact_facing)
    return StateSteering(bundle.graph, table, bundle.annotation, exact_facing=exact_facing)
