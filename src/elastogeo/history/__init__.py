"""The store of machines, tests and results: what was measured, when, by what it was evaluated, and what was done about it.

One file of SQLite, or PostgreSQL, by the same code (SQLAlchemy Core). Raw files lie beside it under their hash and are never
altered. Fills the results of `changes` and keeps the JSON of the views of `report`; the command line and the pages open it.
The ground wing is `store`: tables, engine, migrations, files, audit trail. SQLAlchemy and Alembic come with the extra
`history`.
"""
