/** A motor with a joint. */
namespace yarp demo

include "first/limits.thrift"

typedef list<double> Path
const i32 JOINTS = 2

enum Mode {
  /** No torque. */
  IDLE,
  POSITION = 5  // follows a position
}

/** What the motor measures. */
struct Status {
  1: double position,  // [deg]
  /** Velocity in degrees per second. */
  2: double velocity
  3: Mode mode = Mode.POSITION
  4: list<limits.Limits> limits
  5: map<string, list<i32>> counts
  6: binary raw
  7: Vector torques  /**< [Nm] */
}

struct Vector { } (yarp.name = "yarp::sig::Vector")

exception Blocked { 1: string reason }

service Base {
  /** The version of the firmware. */
  string get_version();
}

service Motor extends Base {
  /**
   * Moves the joint.
   * @param angle the target [deg]
   * @return whether it is within the limits
   */
  bool move_to(1: double angle, 2: limits.Speed speed = 10.0) throws (1: Blocked blocked);
  list<double> follow(1: Path path, 2: set<string> names);
  oneway void stop();
  Status get_status();
  void reset();
}
