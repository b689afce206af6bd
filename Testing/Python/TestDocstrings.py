# SPDX-License-Identifier: BSD-3-Clause
"""help() says something of every filter and of every method of its own."""
import labelmesh

filters = [value for name, value in vars(labelmesh).items() if name.startswith("vtk") and isinstance(value, type)]
assert len(filters) >= 12, filters
methods = 0
for kind in filters:
    assert len(kind.__doc__ or "") > 200, f"{kind.__name__} is not described"
    for name, value in vars(kind).items():
        if name.startswith("_") or not callable(value) or isinstance(value, type):
            continue
        methods += 1
        text = value.__doc__ or ""
        assert name in text, f"{kind.__name__}.{name} has no docstring"
assert "Epsilon" in labelmesh.vtkLabelMesher.SetEpsilon.__doc__
assert "edge length over feature size" in labelmesh.vtkLabelMesher.SetEpsilon.__doc__
print(f"{len(filters)} filters, {methods} methods")
