"""What a column or channel may be, guessed from its name: a proposal for a person to confirm, never taken by itself.

The words are those of controls, data loggers and ball-bar software in English, German, French, Italian and Spanish.
"""

from __future__ import annotations

import re

from elastogeo.errors import FormatError
from elastogeo.formats.text.units import QUANTITIES, UNITS, dimensions_of, is_rated, split_unit

_WORDS = {
    "time": "time timestamp zeit zeitstempel uhrzeit temps tempo tiempo",
    "angle": "angle winkel angolo angulo ángulo",
    "radial": "radial radius radialabweichung abweichung ecart écart deviation scostamento desviacion desviación",
    "displacement": "displacement verschiebung weg dial taster deplacement déplacement spostamento desplazamiento",
    "pressure": "pressure druck pression pressione presion presión",
    "feed": "feed fed feedrate vorschub avance avanzamento",
    "velocity": "velocity speed vel geschwindigkeit istgeschwindigkeit vitesse velocita velocità velocidad drehzahl vact",
    "acceleration": "acceleration accel acc beschleunigung accelerazione aceleracion aceleración",
    "torque": "torque moment drehmoment couple coppia par load auslastung last charge carico carga trq",
    "force": "force kraft forza fuerza cutting_force",
    "current": "current cur curr strom motorstrom iststrom courant corrente corriente iq",
    "position": "position pos lage lageistwert istposition posición posizione posicion encoder",
    "temperature": "temperature temperatur temp temperatura",
}
_QUANTITY = {word: quantity for quantity, words in _WORDS.items() for word in words.split()}
_OF_AN_AXIS = ("position", "velocity", "acceleration", "torque", "force", "current")
_AXIS = re.compile(r"(?P<axis>[xyzabcuvw])(?:axis|achse)?\d?", re.IGNORECASE)
_TOKENS = re.compile(r"[A-Z]+(?![a-z])|[A-Z]?[^\W\d_A-Z]+\d*|\d+")
_NOT_ACTUAL = frozenset(
    ["soll", "set", "cmd", "command", "commanded", "target", "nominal", "consigne", "setpoint", "ref", "reference"]
)


def guessed_quantity(name: str, unit: str = "") -> str:
    """The quantity that a name may mean (`current_x`), with the axis that it names; empty if it shows none.

    Parameters
    ----------
    name : str
        Of a column or channel, as the file spells it.
    unit : str
        Of its values, if it is known: a quantity that cannot have it is not proposed.
    """
    said = _said(name, unit)
    if said:
        return said
    tokens = [token.lower() for part in re.split(r"[^\w]+|_", name) for token in _TOKENS.findall(part)]
    if _NOT_ACTUAL & set(tokens):
        return ""
    quantity = next((_QUANTITY[token] for token in tokens if token in _QUANTITY), "")
    if not quantity or not _allowed(quantity, unit):
        return ""
    axis = next((found["axis"].lower() for token in tokens if (found := _AXIS.fullmatch(token))), "")
    return f"{quantity}_{axis}" if axis and quantity in _OF_AN_AXIS else quantity


def _said(name: str, unit: str) -> str:
    """The quantity that a name says in our own words."""
    try:
        quantity, own = split_unit(name)
    except FormatError:
        return ""
    known = dimensions_of(quantity) or quantity in QUANTITIES
    return quantity if known and _allowed(quantity, own or unit) else ""


def _allowed(quantity: str, unit: str) -> bool:
    expected = dimensions_of(quantity)
    fits = unit not in UNITS or not expected or UNITS[unit].dimension in expected
    return not unit or fits or (unit == "%" and is_rated(quantity))
