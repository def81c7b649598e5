"""The report of the touch demo, from recordings."""

import pytest
from matplotlib.image import imread

from robocomp_dsl.simulation.view.offscreen import NoRendering
from tests.demo.touch_demo_samples import demo, recording

program = demo().demo
report = demo().report
NAO = demo().subject.SUBJECTS["nao"]


def test_touch_report_lists_all_touches_in_one_line_each() -> None:
    body = demo().body.Body(NAO.world, recording().skin, NAO.part)
    rows = demo().metrics.outcomes(recording(), body)
    assert report.facts(rows) == (
        "2 of 2 touches: the arm withdrew by 58 to 91 mm"
        " · first motion 60 ms after the contact · free after 140 ms"
    )
    some = demo().metrics.outcomes(recording(answers=recording().answers[2:]), body)
    assert report.facts(some).startswith("1 of 2 touches: the arm withdrew by 91 mm · ")
    none = demo().metrics.outcomes(recording(force=0.0), body)
    assert report.facts(none) == "0 of 2 touches: the arm withdrew"


def test_touch_report_writes_table_and_picture_without_problems(tmp_path, capsys) -> None:
    assert report.report([NAO], [recording()], tmp_path / "a.png") == []
    message = capsys.readouterr().out.splitlines()
    assert [line.split()[0] for line in message if line.strip()][:4] == ["robot", "N", "NAO", "NAO"]
    assert message[-1] == f"picture: {tmp_path / 'a.png'}"
    assert imread(tmp_path / "a.png").shape[1] == 1600


def test_touch_report_without_renderer_has_no_photographs(tmp_path, capsys, monkeypatch) -> None:
    def nothing(*_: object) -> None:
        raise NoRendering("offscreen rendering is not available: none")

    monkeypatch.setattr(demo().photograph, "Renderer", nothing)
    assert report.report([NAO, NAO], [recording(), recording()], tmp_path / "a.png") == []
    message = capsys.readouterr().out
    why = "no photographs in the picture: offscreen rendering is not available: none\n"
    assert message.count(why) == 1
    assert imread(tmp_path / "a.png").shape[1] == 1600


def test_touch_report_includes_arms_that_stay(tmp_path, capsys) -> None:
    still = recording(motion=0.0)
    assert report.report([NAO], [still], tmp_path / "a.png") == [
        "NAO, lower arm outer: the arm went away by 0 mm only",
        "NAO, lower arm under: the arm went away by 0 mm only",
    ]
    untouched = recording(force=0.0, answers=())
    troubles = report.report([NAO], [untouched], tmp_path / "b.png")
    assert [trouble.rpartition(": ")[2] for trouble in troubles] == ["the skin felt nothing"] * 2
    assert imread(tmp_path / "b.png").shape[1] == 1600


@pytest.mark.parametrize(
    ("options", "message"),
    [
        (["--touches", "0"], "--touches: one at least"),
        (["--picture", "/nowhere/at/all/a.png"], "there is no folder /nowhere/at/all"),
        (["--robot", "asimo"], "invalid choice: 'asimo'"),
    ],
)
def test_touch_demo_reports_invalid_request_before_start(
    monkeypatch, capsys, options, message
) -> None:
    monkeypatch.setattr("sys.argv", ["demo.py", *options])
    with pytest.raises(SystemExit) as ended:
        program.main()
    assert ended.value.code == 2
    assert message in capsys.readouterr().err


@pytest.mark.parametrize(
    ("frozen", "touches", "lines"),
    [([False], 1, 0), ([True, False], 2, 1), ([True, True, True], 3, 2)],
)
def test_touch_report_repeats_touch_of_frozen_reflex(
    monkeypatch, capsys, frozen, touches, lines
) -> None:
    repeated = []

    class Stage:
        class buffer:  # noqa: N801
            @staticmethod
            def frozen_since(time: float) -> bool:
                return frozen[int(time)]

    def press(_stage: object, _body: object, place: object) -> object:
        repeated.append(place)
        return demo().recording.Press("p", float(len(repeated) - 1), 0.0)

    monkeypatch.setattr(program, "press", press)
    last = program.pressed("NAO", Stage(), None, "place")
    assert last.began == touches - 1
    assert len(repeated) == touches
    assert capsys.readouterr().out.count("the reflex was frozen meanwhile") == lines
