"""`viscofric verify` as users meet it: what it prints, in which form, and when it fails."""

from __future__ import annotations

import json
from dataclasses import replace
from functools import partial
from typing import TYPE_CHECKING

from cli import calls
from cli.calls import refusal
from viscofric.cli.verify import _line
from viscofric.contact.periodic.transfer import SlidingSolid
from viscofric.errors import ConvergenceError
from viscofric.verification import CHECKS, Comparison, select

if TYPE_CHECKING:
    import pytest

CHEAP = ("--only", "hertz-cylinder", "--only", "full-contact-wave", "--only", "thin-layers")


call = partial(calls.call, "verify")
succeed = partial(calls.succeed, "verify")


def test_each_check_is_a_line_with_its_worst_number() -> None:
    done = succeed(*CHEAP)
    lines = done.stdout.splitlines()
    assert [line.split()[:2] for line in lines[:-1]] == [
        ["hertz-cylinder", "passed"],
        ["full-contact-wave", "passed"],
        ["thin-layers", "passed"],
    ]
    assert all("expected" in line and "bound" in line for line in lines[:-1])
    assert lines[-1].startswith("All 3 checks passed, 34 comparisons")
    assert done.stderr == ""


def test_details_show_every_comparison_and_the_reasons() -> None:
    done = succeed("--only", "hertz-cylinder", "--details")
    assert done.stdout.count("contact width (m)") == 3  # the worst, and both
    assert "bounds: 128 cells" in done.stdout
    assert "Johnson" in done.stdout


def test_a_check_that_cannot_be_done_has_failed() -> None:
    def broken() -> list[Comparison]:
        raise ConvergenceError("no window was found [at all].")

    (check,) = select(CHECKS, ["hertz-cylinder"])
    line = _line(replace(check, name="broken", compare=broken).run())
    assert line.startswith("broken")
    assert "FAILED" in line
    assert "no window was found [at all]." in line


def test_published_numbers_have_their_origin() -> None:
    listed = call("--published", "--list")
    assert listed.exit_code == 0, listed.output
    assert "wang-knothe" in listed.stdout
    assert "obtained: " in listed.stdout
    assert "unstated: " in listed.stdout
    done = succeed("--published", "--only", "frontistr-card", "--details")
    assert "obtained: Run by hand" in done.stdout
    (check,) = json.loads(call("--published", "--only", "frontistr-card", "--json").stdout)["checks"]
    assert {"obtained", "unstated"} <= set(check)
    assert call("--published", "--only", "hertz-ball").exit_code == 1  # is none of these


def test_json_holds_everything() -> None:
    done = succeed(*CHEAP, "--json")
    found = json.loads(done.stdout)
    assert found["passed"] is True
    assert [one["name"] for one in found["checks"]] == list(CHEAP[1::2])
    for check in found["checks"]:
        assert check["source"]
        assert check["reason_of_bounds"]
        for one in check["comparisons"]:
            assert one["passed"] == (one["error"] <= one["bound"])


def test_a_wrong_engine_is_reported_with_status_one(monkeypatch: pytest.MonkeyPatch) -> None:
    original = SlidingSolid.transfer
    monkeypatch.setattr(SlidingSolid, "transfer", lambda *arguments: 1.03 * original(*arguments))
    done = call(*CHEAP)
    assert done.exit_code == 1
    assert "full-contact-wave  FAILED" in done.stdout
    assert "2 of 3 checks FAILED: full-contact-wave, thin-layers." in done.stdout
    assert "Traceback" not in done.output
    assert json.loads(call(*CHEAP, "--json").stdout)["passed"] is False


def test_another_backend_is_checked() -> None:
    done = succeed("--only", "hertz-cylinder", "--only", "full-contact-wave", "--backend", "array_api_strict", "--json")
    found = json.loads(done.stdout)
    assert found["backend"] == "array_api_strict"
    assert found["passed"] is True
    assert refusal("verify", "--only", "hertz-cylinder", "--backend", "fortran")[:2] == (1, "unknown-backend")


def test_checks_are_listed_with_their_sources() -> None:
    done = succeed("--list")
    for check in CHECKS:
        assert check.name in done.stdout
        assert check.title in done.stdout
        assert check.source in done.stdout


def test_an_unknown_check_is_one_sentence() -> None:
    assert refusal("verify", "--only", "hertz")[:2] == (1, "unknown-check")
