"""Many designs of one mechanism: ``compile`` and its results.

In: a ``Mechanism``, the varied numbers, the outputs. Out: a ``Kernel``, whose calls return a ``BatchResult``. Imports
``kernel``, ``core``, ``analysis``.
"""

from dalembert.analysis.batch.batch_result import BatchResult
from dalembert.analysis.batch.compiled_kernel import Kernel, compile  # noqa: A004

__all__ = ["BatchResult", "Kernel", "compile"]
