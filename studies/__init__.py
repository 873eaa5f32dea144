"""How often each check of a verdict alarms and is silent: simulation studies, and the test maker that they stand on.

The test maker shares no physics with `elastogeo`: its chain of homogeneous transforms, its loads and its noise are its own.
From `elastogeo` it takes the classes that a test is made of, in `bar_tests` alone. From the root of the repository:

    from studies.bar_tests import make_test
    from studies.truth import TABLE_5_5, Truth

    test = make_test("15 runs", Truth(TABLE_5_5, softening=-0.2), "of the run", seed=3)
"""

import os

os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")  # before numpy: workers on shared cores wait for each other's threads
