"""elastogeo: loaded-test metrology of machine tools.

Where is this machine soft, where is it crooked, how sure are we, and what could this test not tell?
The rooms, from the ground up: `errors`, `estimate`, `machine`, `observe`, `sources`, `formats`, `identify`, `report`,
`cli`. Imports only go down. This file imports nothing, so that `elastogeo --help` answers at once.
"""

__version__ = "0.1.0"
