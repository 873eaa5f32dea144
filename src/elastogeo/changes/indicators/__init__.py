"""What is watched of each kind of result: a few indicators, each determined by the test alone. One file a kind of result."""

from elastogeo.changes.indicators.register import indicates, indicators_of, watched
from elastogeo.changes.indicators.signatures import faults_of, signatures_of

__all__ = ["faults_of", "indicates", "indicators_of", "signatures_of", "watched"]
