#!/usr/bin/env bash
# Installs ROS 2 (rclpy with Fast DDS), Cyclone DDS and zenoh-ros2-sdk for the tests of the
# middlewares `ros2`, `dds` and `rmw_zenoh`: 260 MB from PyPI, one minute.
# In: a Python, and the folder of the environment to create. It is not .venv, so that the other
# tests run without ROS.
set -euo pipefail
python=$1 environment=$2
ready=$environment/.ready

if [ ! -e "$ready" ] || [ pyproject.toml -nt "$ready" ]; then
  echo "setting up $environment (once, a minute) ..."
  "$python" -m venv "$environment"
  "$environment/bin/python" -m pip install -q --disable-pip-version-check -e '.[ros2,dds]' \
    'zenoh-ros2-sdk==0.1.8' 'pytest>=9' 'pytest-timeout>=2.3' 'pytest-asyncio' 'hypothesis>=6.100'
  touch "$ready"
fi
