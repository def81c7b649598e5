"""An arm of three joints and its devices."""

from __future__ import annotations

ARM = """\
<innerModel>
  <transform id="base">
    <joint id="pan" axis="y" min="-1.5" max="1.5">
      <joint id="tilt" axis="x" min="-1.5" max="1.5">
        <transform id="upper" tz="200">
          <joint id="elbow" axis="x" min="-1.5" max="1.5"><transform id="hand" tz="150"/></joint>
        </transform>
      </joint>
    </joint>
  </transform>
</innerModel>
"""
