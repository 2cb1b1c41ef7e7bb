"""Many designs of one mechanism: ``compile`` and what it answers.

In: a ``Mechanism``, what varies, what is asked for. Out: a ``Kernel``, whose calls answer a ``BatchResult``.
Imports ``kernel``, ``core``, ``analysis``.
"""

from dalembert.analysis.batch.batch_result import BatchResult
from dalembert.analysis.batch.compiled_kernel import Kernel, compile  # noqa: A004

__all__ = ["BatchResult", "Kernel", "compile"]
