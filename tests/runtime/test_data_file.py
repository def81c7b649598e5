"""Files that parameters name: the search path, and the message when there is no such file."""

from __future__ import annotations

from pathlib import Path

import pytest

from robocomp_dsl.runtime.config.data_file import data_file
from robocomp_dsl.runtime.config.search_environment import SearchEnvironment
from robocomp_dsl.runtime.parameters import ConfigError

PLACES = (  # in the order of the search, below a folder of the test
    "beside",
    "working",
    "working/etc",
    "home/robots/arm7",
    "data/robots/arm7",
    "shared/robots/arm7",
    "home",
    "shared",
)


def search_environment(folder: Path):
    for place in PLACES:
        (folder / place).mkdir(parents=True, exist_ok=True)
    environment = {
        "ROBOCOMP_CONFIG_HOME": str(folder / "home"),
        "ROBOCOMP_DATA_HOME": str(folder / "data"),
        "ROBOCOMP_CONFIG_DIRS": str(folder / "shared"),
        "ROBOCOMP_DATA_DIRS": str(folder / "installed"),
        "ROBOCOMP_ROBOT_NAME": "arm7",
    }
    return SearchEnvironment.from_environ(environment, folder / "working")


def find_beside_config(name: str, folder: Path) -> Path:
    return data_file(name, "map", folder / "beside" / "config.yaml", search_environment(folder))


@pytest.mark.parametrize("first", range(len(PLACES)))
def test_data_file_returns_first_match_of_search_path(first: int, tmp_path: Path) -> None:
    environment = search_environment(tmp_path)
    for place in PLACES[first:]:
        (tmp_path / place / "map.yaml").write_text(place)
    path = data_file("map.yaml", "map", tmp_path / "beside" / "config.yaml", environment)
    assert path == tmp_path / PLACES[first] / "map.yaml"


def test_data_file_without_config_searches_working_folder_first(tmp_path: Path) -> None:
    environment = search_environment(tmp_path)
    (tmp_path / "working" / "map.yaml").write_text("")
    assert data_file("map.yaml", "map", None, environment) == tmp_path / "working" / "map.yaml"


@pytest.mark.parametrize("name", ["{}/far/map.yaml", "../far/map.yaml", "../far/../far/map.yaml"])
def test_data_file_accepts_explicit_path(name: str, tmp_path: Path) -> None:
    (tmp_path / "far").mkdir()
    (tmp_path / "far" / "map.yaml").write_text("")
    path = find_beside_config(name.format(tmp_path), tmp_path)
    assert path.resolve() == tmp_path / "far" / "map.yaml"


def test_data_file_expands_home_folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("HOME", str(tmp_path))
    (tmp_path / "map.yaml").write_text("")
    assert find_beside_config("~/map.yaml", tmp_path) == tmp_path / "map.yaml"


def test_data_file_not_found_lists_folders_and_similar_name(tmp_path: Path) -> None:
    (tmp_path / "home").mkdir()
    (tmp_path / "home" / "mapp.yaml").write_text("")
    (tmp_path / "home" / "other.toml").write_text("")
    with pytest.raises(ConfigError) as caught:
        find_beside_config("map.yaml", tmp_path)
    message = str(caught.value)
    assert "file not found: `map.yaml`" in message
    assert "parameter map:1:1" in message
    assert "did you mean `mapp.yaml`?" in message
    places = [message.index(f"{tmp_path / place / 'map.yaml'}") for place in PLACES]
    assert places == sorted(places)


@pytest.mark.parametrize("name", ["", ".", "/", "..", "a\0b", "x" * 300, "folder"])
def test_data_file_rejects_name_that_is_no_file(name: str, tmp_path: Path) -> None:
    (tmp_path / "beside" / "folder").mkdir(parents=True)
    with pytest.raises(ConfigError, match="file not found"):
        find_beside_config(name, tmp_path)
