// What ROS 2 users may tell the robot: readers of the topics that the configuration opens.
#pragma once

#include <dds/dds.h>

#include "config/config.h"
#include "link/unique_fd.h"

namespace drover::ros2 {

class Heard final {
 public:
  /// Readers are the last that a domain gets: by then its sockets are closed. Throws NoDomain.
  Heard(dds_entity_t participant, const config::Ros2InputsConfig& inputs);
  ~Heard();
  Heard(const Heard&) = delete;
  Heard& operator=(const Heard&) = delete;

  /// Readable when something came.
  int fd() const { return came_.get(); }
  /// Takes all that came: whether one of it asks for an emergency stop.
  bool stop_asked();

 private:
  link::UniqueFd came_;
  int fd_ = -1;            ///< its number, for the listener
  dds_entity_t stop_ = 0;  ///< 0: not opened
};

}  // namespace drover::ros2
