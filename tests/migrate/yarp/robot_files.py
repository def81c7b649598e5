"""A robot of yarprobotinterface with the constructs of public ones, in several files."""

ARM = {
    "arm.xml": """\
<?xml version="1.0" encoding="UTF-8" ?>
<!DOCTYPE robot PUBLIC "-//YARP//DTD yarprobotinterface 3.0//EN" "http://x/V3.0.dtd">
<robot name="armbot" build="1" portprefix="arm_robot" xmlns:xi="http://www.w3.org/2001/XInclude">
  <!-- ------ motors -- and their wrapper ------ -->
  <devices>
    <xi:include href="hardware/upper-mc.xml"/>
    <xi:include href="hardware/wrist-mc.xml"/>
    <xi:include href="wrappers/arm-mc_wrapper.xml"/>
    <xi:include href="calibrators/arm-calib.xml"/>
    <xi:include href="hardware/skin.xml" enabled_by="skin touch"/>
    <xi:include href="hardware/imu.xml" disabled_by="no_imu"/>
  </devices>
</robot>
""",
    "general.xml": """\
<params robot="armbot" build="1">
  <group name="GENERAL"><param name="skipCalibration"> false </param></group>
</params>
""",
    "hardware/upper-mc.xml": """\
<device xmlns:xi="http://www.w3.org/2001/XInclude" name="upper-mc" type="embObjMotionControl">
  <xi:include href="../general.xml"/>
  <group name="GENERAL">
    <param name="Joints"> 3 </param>
    <param name="AxisName"> "shoulder_pitch" "shoulder_roll" "lift" </param>
    <param name ="AxisType"> "revolute" "revolute" "prismatic" </param>
  </group>
  <group name="LIMITS">
    <param name="jntPosMax"> 60 90 0.2 </param>
    <param name="jntPosMin"> -60 10 0 </param>
    <param name="jntVelMax"> 90 0 0.5 </param>
  </group>
</device>
""",
    "hardware/wrist-mc.xml": """\
<devices robot="armbot" build="1">
  <device name="wrist-mc" type="fakeMotionControl">
    <group name="GENERAL"><param name="Joints">2</param>
      <param name="AxisName">(wrist_yaw none)</param></group>
    <group name="LIMITS"><param name="jntPosMax">45 0</param><param name="jntPosMin">-45 0</param>
    </group>
  </device>
</devices>
""",
    "wrappers/arm-mc_wrapper.xml": """\
<device name="arm-mc_wrapper" type="controlboardwrapper2">
  <paramlist name="networks">
    <elem name="upper">( 0 2 0 2 )</elem>
    <elem name="wrist">  3 4 0 1  </elem>
  </paramlist>
  <param name="name"> ${portprefix}/arm </param>
  <param name="joints"> 5 </param>
  <action phase="startup" level="5" type="attach">
    <paramlist name="networks">
      <elem name="upper"> upper-mc </elem>
      <elem name="wrist"> wrist-mc </elem>
    </paramlist>
  </action>
  <action phase="shutdown" level="5" type="detach"/>
</device>
""",
    "calibrators/arm-calib.xml": """\
<device name="arm-calib" type="parametricCalibratorEth">
  <group name="HOME">
    <param name="positionHome"> 30 45 0.1 0 0 </param>
    <param name="velocityHome"> 10 10 0.1 10 10 </param>
  </group>
  <group name="CALIBRATION">
    <param name="startupPosition"> 15 45 0.15 90 0 </param>
    <param name="startupVelocity"> 180 180 0.1 90 90 </param>
    <param name="startupTimeout"> 30 25 30 30 30 </param>
  </group>
  <action phase="startup" level="10" type="calibrate">
    <param name="target"> arm-mc_wrapper </param>
  </action>
  <action phase="interrupt1" level="1" type="park">
    <param name="target"> arm-mc_wrapper </param>
  </action>
  <action phase="interrupt3" level="1" type="abort"/>
  <action phase="shutdown" level="9" type="detach"/>
</device>
""",
    "hardware/skin.xml": '<device name="arm_skin" type="embObjSkin"/>\n',
    "hardware/imu.xml": """\
<devices>
  <device name="imu" type="imuBosch_BNO055"><param name="comport" extern-name="imu_port">/dev/t
  </param></device>
  <device name="imu server" type="multipleanalogsensorsserver">
    <action phase="startup" level="5" type="attach"><param name="device">imu</param></action>
  </device>
  <device name="eye" type="fakeFrameGrabber"/>
</devices>
""",
}
