"""Model files for the tests."""

from __future__ import annotations

from typing import Any

from tests.simulation.served_worlds import Served

ARM = """\
<mujoco model="arm">
  <option timestep="0.001"/>
  <worldbody>
    <geom name="floor" type="plane" size="2 2 .1" pos="0 0 -2"/>
    <camera name="eye" pos="0 -2 0.5" xyaxes="1 0 0 0 0 1" resolution="64 48" output="rgb depth"/>
    <camera name="far" pos="0 -4 0.5" xyaxes="1 0 0 0 0 1"/>
    <body name="upper" pos="0 0 1">
      <joint name="shoulder" axis="0 1 0" range="-90 90" damping="0.2" armature="0.02"/>
      <geom name="upper" type="capsule" fromto="0 0 0 0.3 0 0" size="0.04" mass="0.4"/>
      <body name="lower" pos="0.3 0 0">
        <joint name="elbow" axis="0 1 0" range="-120 0" damping="0.2" armature="0.02"/>
        <geom name="lower" type="capsule" fromto="0 0 0 0.25 0 0" size="0.03" mass="0.3"/>
        <site name="wrist" pos="0.25 0 0" size="0.05"/>
        <body name="jaw" pos="0.25 0 0">
          <joint name="grip" type="slide" axis="0 1 0" range="0 0.05" damping="5" armature="0.1"/>
          <geom name="jaw" type="box" size="0.02 0.005 0.02" mass="0.05"/>
        </body>
        <body name="mate" pos="0.25 0 0">
          <joint name="follower" type="slide" axis="0 -1 0" range="0 0.05" armature="0.1"/>
          <geom name="mate" type="box" size="0.02 0.005 0.02" mass="0.05" contype="0"/>
        </body>
      </body>
    </body>
    <body name="door" pos="0 2 0">
      <joint name="hinge" axis="0 0 1"/>
      <geom name="door" type="box" size="0.4 0.02 0.9" pos="0.4 0 0" mass="5"/>
    </body>
    <body name="ball" pos="1 1 0">
      <freejoint/>
      <geom name="ball" size="0.05" mass="0.1"/>
    </body>
    <body name="hand" mocap="true" pos="-1 0 1">
      <geom name="hand" size="0.05" contype="0" conaffinity="0"/>
    </body>
  </worldbody>
  <equality><joint joint1="follower" joint2="grip"/></equality>
  <actuator>
    <motor name="m" joint="shoulder" gear="20" ctrlrange="-1 1"/>
    <position joint="elbow" kp="50" forcerange="-12 12"/>
    <velocity joint="elbow" kv="5"/>
    <general name="g" joint="grip" gainprm="40" ctrlrange="0 1"/>
  </actuator>
  <sensor>
    <gyro site="wrist"/>
    <accelerometer site="wrist"/>
    <touch name="palm" site="wrist"/>
  </sensor>
  <custom>
    <tuple name="arm">
      <element objtype="joint" objname="elbow"/>
      <element objtype="joint" objname="shoulder"/>
    </tuple>
    <numeric name="speed_elbow" data="3.5"/>
  </custom>
  <keyframe>
    <key name="home" qpos="0.5 -1 0.01 0.01 0.2  1 1 -1 1 0 0 0"/>
    <key name="other" qpos="0 0 0 0 0  1 1 0 1 0 0 0"/>
  </keyframe>
</mujoco>
"""

BOT = """\
<robot name="bot">
  <link name="base"/>
  <link name="column"><inertial><mass value="2"/>
    <inertia ixx="0.1" iyy="0.1" izz="0.1" ixy="0" ixz="0" iyz="0"/></inertial>
    <collision><geometry><box size="0.1 0.1 0.5"/></geometry></collision></link>
  <link name="tool"><inertial><mass value="1"/>
    <inertia ixx="0.02" iyy="0.02" izz="0.02" ixy="0" ixz="0" iyz="0"/></inertial></link>
  <joint name="lift" type="prismatic"><parent link="base"/><child link="column"/>
    <axis xyz="0 0 1"/><limit lower="0" upper="0.5" effort="200" velocity="0.25"/></joint>
  <joint name="turn" type="revolute"><parent link="column"/><child link="tool"/>
    <origin xyz="0 0 0.5"/><axis xyz="1 0 0"/>
    <limit lower="-1.5" upper="1.5" effort="40" velocity="2"/></joint>
</robot>
"""


def goal(world: Served, name: str, position: float, speed: float = 0.0) -> Any:
    """A command for one motor; a speed of 0 is the default speed."""
    return world.types.MotorGoalPosition(name, position, speed)
