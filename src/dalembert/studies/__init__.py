"""Many designs of one mechanism, drawn, analysed block by block, stored and resumed: ``da.study``.

In: a ``Mechanism``, the laws of its varied numbers, the outputs. Out: a ``Study``, its store, its statistics. Imports
``analysis``.
"""

from dalembert.studies.design_study import Study, study
from dalembert.studies.study_result import StudyResult

__all__ = ["Study", "StudyResult", "study"]
