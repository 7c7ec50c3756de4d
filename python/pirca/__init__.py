"""pirca: how strong is a dry stone wall whose every stone is different, and how sure are we?

>>> import pirca
>>> study = pirca.Study("studies/joint-arrangement", members=30)
>>> run = study.run()
>>> run.members.to_polars()

`pirca.analyse` answers for a wall of one's own, from arrays, meshes or a file. All that is computed is computed by the same library as
by the command line, with the same files to the byte; one command is done at a time, on all processors.
"""

from pirca._native import VERSION as __version__
from pirca.analysis import Analysis, analyse
from pirca.answer import Answer, ask
from pirca.errors import Error, InputError, RunError, UsageError
from pirca.figure import Figure
from pirca.run import Run
from pirca.study import Study
from pirca.table import Table
from pirca.wall import Block, Wall

__all__ = [
    "Analysis",
    "Answer",
    "Block",
    "Error",
    "Figure",
    "InputError",
    "Run",
    "RunError",
    "Study",
    "Table",
    "UsageError",
    "Wall",
    "__version__",
    "analyse",
    "ask",
]
