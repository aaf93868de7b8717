// A ROS 2 user on the robot's computer who is Fast DDS. Nothing of its headers is in here.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "integration/ros2_fastdds_scene_messages.h"

namespace drover::test::fast {

using Bytes = std::vector<std::uint8_t>;

/// What a reader asks for, or a writer offers.
struct Quality {
  bool reliable = true;
  bool for_later = false;  ///< transient local
  double deadline_s = 0;   ///< 0: none
  bool exclusive = false;  ///< of several writers the strongest only
};

template <class M>
struct Seen {
  M message;
  Bytes bytes;  ///< as they came, with the header of the encapsulation
};

template <class M>
class Reader {
 public:
  virtual ~Reader() = default;
  /// The newest one since the last call.
  virtual std::optional<Seen<M>> newest() = 0;
  virtual int writers() const = 0;
  /// Writers that do not offer what it asks for.
  virtual int refused() const = 0;
};

template <class M>
class Writer {
 public:
  virtual ~Writer() = default;
  virtual bool write(const M& message) = 0;
  virtual int readers() const = 0;
  virtual int refused() const = 0;
};

/// How he was told to stay on this computer.
enum class Told : std::uint8_t {
  nothing,      ///< Fast DDS's defaults, which ROS 2 leaves as they are
  by_our_file,  ///< config/ros2/fastdds.xml
  by_humble,    ///< ROS_LOCALHOST_ONLY=1, as rmw_fastrtps of Humble reads it
  by_jazzy,     ///< ROS_AUTOMATIC_DISCOVERY_RANGE=LOCALHOST, as rmw_fastrtps of Jazzy reads it
};

class User final {
 public:
  /// `file`: config/ros2/fastdds.xml. Throws std::runtime_error.
  User(int domain, Told told, const std::string& file);
  ~User();

  /// They end before the user does.
  template <class M>
  std::unique_ptr<Reader<M>> reader(const std::string& topic, const Quality& quality = {});
  template <class M>
  std::unique_ptr<Writer<M>> writer(const std::string& topic, const Quality& quality = {});

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

/// By Fast-CDR, little endian, with the header of the encapsulation.
template <class M>
Bytes to_cdr(const M& message);
/// Nothing: they are none of that type.
template <class M>
std::optional<M> from_cdr(const Bytes& bytes);

}  // namespace drover::test::fast
