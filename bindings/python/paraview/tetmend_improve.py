# SPDX-License-Identifier: MIT
"""ParaView: improves the tets of the active source. One file: Macros > Import new macro...

The macro adds a programmable filter to the pipeline; its settings stand at the top of the script that it shows. The Python of
ParaView must find the package tetmend (`import tetmend`, in View > Python Shell, tells). Outside ParaView,
`execute(filter)` is what the filter does, for any VTK filter with one unstructured grid in and one out.
"""

SCRIPT = """\
# Settings: the options of tetmend.vtk.improve().
options = dict(schedule="shell", goal=(30, 150), threads=1)

import tetmend.vtk
better = tetmend.vtk.improve(self.GetInputDataObject(0, 0), **options)
self.GetOutputDataObject(0).ShallowCopy(better)
"""


def execute(self):
    """Runs the script as a programmable filter does, with the filter as `self`."""
    exec(compile(SCRIPT, "tetmend_improve", "exec"), {"self": self})


def add_filter():
    """Adds the filter behind the active source of ParaView, and shows it."""
    from paraview import simple

    source = simple.GetActiveSource()
    if source is None:
        raise RuntimeError("tetmend: select a source with an unstructured grid first")
    better = simple.ProgrammableFilter(registrationName="tetmend", Input=source)
    better.OutputDataSetType = "vtkUnstructuredGrid"
    better.Script = SCRIPT
    simple.Show(better)
    simple.Hide(source)
    simple.Render()


try:
    import paraview  # noqa: F401
except ImportError:
    pass
else:
    if __name__ in ("__main__", "__vtkconsole__"):
        add_filter()
