const map<string, i32> NUMBERS = {"one": 1}
const Mode FIRST = Mode.ON

struct Optional {
  1: optional i32 number
  2: optional i32 other = 1
  3: list<i32> numbers = [1, 2]
  4: map<i32, i32> empty = {}
}

struct Foreign { } (yarp.name = "yarp::os::Property")

enum Mode { } (yarp.name = "yarp::dev::Mode")
