"""What a new ball-roller test begins with."""

from elastogeo.observe.template import Template

_SETUP = """\
[setup]
feed_mm_min = 1000
# tool_mm = [0, 0, -150]         # centre of the roller in the last tool-side carriage, if not the machine's tool point

[setup.circle]
radius_mm = 56.4                 # where ball and roller just touch: the sum of their radii
plane = "XY"
centre = { @CENTRE@ }            # axis commands at the centre

[[setup.drives]]                 # one for each axis that presses
axis = "X"
torque_constant_N_m_per_A = 1.65
pitch_mm = 10
efficiency = 0.9
relative_uncertainty = 0.02      # of the force per current

[[setup.drives]]
axis = "Y"
torque_constant_N_m_per_A = 1.52
pitch_mm = 10
efficiency = 0.9
relative_uncertainty = 0.02

[setup.setup]                    # compliance of ball and roller bearing together, from an indicator test
engagement_um = [40, 80, 120, 160, 200]
compliance_um_per_N = [0.0529, 0.0578, 0.0613, 0.0633, 0.0690]
standard_uncertainty_um_per_N = 0.002
"""

_SIMULATION = """\
readings = 700
start_deg = 0
end_deg = 385                    # a little more than a turn: the ends are lost to the low-pass

[imperfection]
noise_um = 0.1                   # of the encoders
resolution_um = 0.1
current_noise_A = 0.03
eccentricity_um = 0.1            # of the centre, from run to run
force_scatter = 0.002            # relative, from run to run

[values]                         # true parameters, in mm, N, rad
C_XXX = 6.9e-5
C_YYY = 6.2e-5
E_XX1 = -5e-5
E_YY1 = 3e-5

[[setup.balances]]               # what the drives need by themselves: true, and not known to the test
axis = "X"
inertia_kg_m2 = 0.006
viscous_N_m_s_per_rad = 0.09
coulomb_N_m = 1.55

[[setup.balances]]
axis = "Y"
inertia_kg_m2 = 0.004
viscous_N_m_s_per_rad = 0.07
coulomb_N_m = 1.60
"""

TEMPLATE = Template(
    title="Ball-roller test",
    setup=_SETUP,
    columns="time_s, position_x_mm, current_x_A, position_y_mm, current_y_A",
    simulation=_SIMULATION,
    machine="huron_kx8",
    level="engagement",
    levels=(0.0, 0.04, 0.12, 0.2),
    both_ways=True,
    repeats=2,
)
