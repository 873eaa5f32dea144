"""How Alembic runs here: on the connection that it is given, in the transaction that is begun already."""

from alembic import context

from elastogeo.history.store.migrations import VERSION_TABLE
from elastogeo.history.store.schema import metadata

context.configure(
    connection=context.config.attributes["connection"],
    target_metadata=metadata,
    version_table=VERSION_TABLE,
    transactional_ddl=True,
    render_as_batch=True,
)
with context.begin_transaction():
    context.run_migrations()
