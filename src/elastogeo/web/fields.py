"""What a person gives, in a form or in the query of an address, and how much of it."""

from typing import Annotated

from fastapi import Form, Query

Key = Annotated[int, Query(ge=0, le=2**53)]
"""Of a row of the history; 0: none."""
Number = Annotated[int, Query(ge=1, le=100_000)]
"""Of a page of a long table, from 1."""
Word = Annotated[str, Query(max_length=200)]
"""What is filtered or searched by."""
Why = Annotated[str, Form(max_length=2000)]
"""The reason of an act, for the audit trail; or a note."""
