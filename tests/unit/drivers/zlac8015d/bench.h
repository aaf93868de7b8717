// A ZLAC8015D beside its twin, for tests of what is its own.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "drivers/zlac8015d/driver.h"
#include "support/describe.h"
#include "unit/drivers/conformance/harness.h"

namespace drover::zlac8015d {

inline constexpr auto kRun = AxisRequest::run;
inline constexpr auto kRest = AxisRequest::rest;

/// Made when it is asked for: the table of options is filled at the program's start.
inline const Settings& settings() {
  static const Settings all = read_settings(Options(option_table()));
  return all;
}

/// The registry's driver beside its twin.
struct Bench : test::CanBench {
  Bench() : CanBench(subject()) {}
  static test::Subject subject() {
    const DriverEntry* const entry = find_driver("zlac8015d");
    return {entry, test::example_options(*entry), "zlac8015d"};
  }
  void arm() {
    run(std::chrono::milliseconds(800), kRest);
    run(std::chrono::milliseconds(500), kRun, 0.0);
    ASSERT_EQ(status.state, AxisState::running) << status.reason.view();
  }
  bool has_sent(const std::string& frame) const {
    return std::any_of(sent.begin(), sent.end(),
                       [&](const CanFrame& each) { return test::describe(each) == frame; });
  }
};

}  // namespace drover::zlac8015d
