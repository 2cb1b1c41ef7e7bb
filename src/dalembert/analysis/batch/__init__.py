"""Many designs of one mechanism: ``compile`` and what it answers."""

from dalembert.analysis.batch.answer import BatchResult
from dalembert.analysis.batch.kernel import Kernel, compile  # noqa: A004

__all__ = ["BatchResult", "Kernel", "compile"]
