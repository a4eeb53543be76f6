"""Cases: scenes whose exact motion is known. ``CASES["spring"](damping=2).error(run)`` is one number.

Each entry is a function of the case's parameters, all with defaults, that returns a Case.

Slides S4, S9, S18; lectures/02_equation_of_motion.md.
"""

from .arches import arch
from .bricard import bricard
from .bridge import bridge
from .cards import card_house
from .case import Case, Catalogue, Motion
from .chains import chain, hanging_chain
from .free_motion import free_fall, planar_flight, projectile_drag, spring, tumbling_box
from .gimbal import gimbal_gyroscope
from .heaps import heap, silo
from .impacts import bounce, cradle
from .linkages import four_bar, n_four_bars, slider_crank
from .orbits import two_body_orbit
from .paradox import kane
from .pendulums import door, double_pendulum, pendulum
from .plate import rolling_plate
from .rods import painleve, rocking_block
from .slopes import descent, pulled_block, rolling, slope, spinning_disc
from .stacks import heavy_on_two, overhang, pyramid, stack, table
from .tops import heavy_top, torque_free_top

CASES = Catalogue(
    "case",
    {
        function.__name__: function
        for function in (
            free_fall,
            projectile_drag,
            spring,
            planar_flight,
            tumbling_box,
            torque_free_top,
            heavy_top,
            two_body_orbit,
            pendulum,
            double_pendulum,
            chain,
            hanging_chain,
            door,
            four_bar,
            slider_crank,
            n_four_bars,
            bricard,
            gimbal_gyroscope,
            stack,
            pyramid,
            heavy_on_two,
            table,
            overhang,
            card_house,
            bridge,
            arch,
            slope,
            pulled_block,
            descent,
            rolling,
            spinning_disc,
            bounce,
            cradle,
            rolling_plate,
            painleve,
            kane,
            rocking_block,
            heap,
            silo,
        )
    },
)

__all__ = ["CASES", "Case", "Motion"]
