"""Many designs of one mechanism, drawn, analysed block by block, stored and resumed: ``da.study``.

In: a ``Mechanism``, how its numbers vary, what is asked. Out: a ``Study``, its store, what the designs say.
Imports ``analysis``.
"""

from dalembert.studies.design_study import Study, study
from dalembert.studies.study_result import StudyResult

__all__ = ["Study", "StudyResult", "study"]
