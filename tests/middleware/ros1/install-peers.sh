#!/usr/bin/env bash
# Installs ROS Noetic of Debian, as the peer of tests: rosmaster, rospy, rostopic, rosservice.
# It needs root or sudo; otherwise its tests are skipped by name (in CI the script fails).
set -euo pipefail

missing=()
for program in rosbag rosmaster rosnode rosparam rostopic rosservice; do
  [ -e "/usr/bin/$program" ] || missing+=("$program")
done
/usr/bin/python3 -c 'import rospy, genpy, sensor_msgs, std_srvs' 2> /dev/null || missing+=(rospy)
[ ${#missing[@]} -eq 0 ] && exit 0

if [ "$(id -u)" = 0 ]; then
  root=(env DEBIAN_FRONTEND=noninteractive)
elif sudo -n true 2> /dev/null; then
  root=(sudo -n env DEBIAN_FRONTEND=noninteractive)
else
  echo "ROS 1 could not be installed, as this needs root: its tests are skipped" >&2
  echo "please run: sudo apt-get install --no-install-recommends ros-base ros-base-python-dev" >&2
  [ -z "${CI:-}" ]
  exit
fi
apt=("${root[@]}" apt-get -qq -o DPkg::Lock::Timeout=300)
"${apt[@]}" update
if ! "${apt[@]}" install -y --no-install-recommends ros-base ros-base-python-dev > /dev/null; then
  echo "this system has no package ros-base: the tests with ROS 1 are skipped" >&2
  [ -z "${CI:-}" ]
fi
