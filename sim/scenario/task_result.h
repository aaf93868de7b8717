// How the task that began last ended: what a scenario is judged by.
#pragma once

#include <cstddef>
#include <string>

#include "drover/time.h"

namespace drover::sim {

struct TaskResult {
  std::size_t target_id = 0;  ///< of the last start, from 1
  Time begin = kNever;        ///< the first task's
  Time end = kNever;          ///< the last task's; kNever: it did not end
  std::string status{};       ///< "NAV_SUCCESS", "NAV_ERROR"; empty as long as it did not end so

  /// One of RobotReport's events, and nav.status at it.
  void happened(const std::string& event, const std::string& nav_status, Time now) {
    if (event == "start_nav") {
      if (begin == kNever) begin = now;
      // How an earlier one ended says nothing of this.
      end = kNever;
      status.clear();
    }
    if (event == "nav_success" || event == "nav_error") {
      end = now;
      status = nav_status;
    }
  }
};

}  // namespace drover::sim
