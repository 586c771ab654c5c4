"""Every public name is described with an example, and the examples say what is true."""

import doctest
import inspect
import warnings

import numpy as np
import pytest

import lamina

DESCRIBED = [name for name in lamina.__all__ if callable(getattr(lamina, name))]
METRIC = "MeshVersionFormatted 2\nDimension 2\nSolAtVertices\n1\n1 3\n4 0 1\nEnd\n"


def run_examples(text, name, folder):
    (folder / "metric.sol").write_text(METRIC)
    test = doctest.DocTestParser().get_doctest(text, {"lamina": lamina, "np": np}, name, None, 0)
    assert test.examples, f"lamina.{name} has no example"
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", lamina.MeshWarning)
        report = []
        assert doctest.DocTestRunner(verbose=False).run(test, out=report.append).failed == 0, "".join(report)


@pytest.mark.parametrize("name", DESCRIBED)
def test_examples(name, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    run_examples(inspect.getdoc(getattr(lamina, name)), name, tmp_path)


def test_examples_of_the_package(tmp_path):
    constants = {name for name in lamina.__all__ if name not in DESCRIBED}
    assert all(name in lamina.__doc__ for name in constants)
    run_examples(lamina.__doc__, "lamina", tmp_path)
