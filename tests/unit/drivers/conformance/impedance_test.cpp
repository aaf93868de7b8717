// What every drive that follows an impedance law must do, on its own twin: all five values, at the
// joint; no step when it is armed; damping as its stop.
#include <gtest/gtest.h>

#include "support/describe.h"
#include "unit/drivers/conformance/harness.h"

namespace drover::test {
namespace {

class Impedances : public ::testing::TestWithParam<Subject> {};

/// Armed, at rest, and told nothing but to damp.
void arm(CanBench& bench) {
  bench.run(milliseconds(1000), AxisRequest::rest);
  bench.run(milliseconds(1000), AxisRequest::run, 0.0);
  ASSERT_EQ(bench.status.state, AxisState::running) << bench.status.reason.view();
}

void follow(CanBench& bench, const Impedance& law, Duration time, double velocity_radps = 0) {
  bench.law = law;
  bench.run(time, AxisRequest::run, velocity_radps);
}

TEST_P(Impedances, BendsUnderAPushAsItsStiffnessSays) {
  CanBench bench(GetParam());
  arm(bench);
  for (const double stiffness : {10.0, 20.0, 50.0}) {
    const Impedance law{.position_rad = 0.2, .stiffness_Nmprad = stiffness, .damping_Nmsprad = 1};
    bench.load_Nm = 0;
    follow(bench, law, milliseconds(2000));
    const double before_rad = bench.shaft.position_rad;
    EXPECT_NEAR(before_rad, 0.2, 0.002);
    EXPECT_NEAR(bench.motion.position_rad, 0.2, 0.002);
    bench.load_Nm = -0.8;
    follow(bench, law, milliseconds(2000));
    EXPECT_NEAR(bench.shaft.position_rad - before_rad, -0.8 / stiffness, 0.08 / stiffness);
  }
}

TEST_P(Impedances, GivesTheTorqueOfAllFive) {
  CanBench bench(GetParam());
  arm(bench);
  const Impedance law{
      .position_rad = 0.4, .effort_Nm = 1.5, .stiffness_Nmprad = 5, .damping_Nmsprad = 0.5};
  bench.load_Nm = -1;
  follow(bench, law, milliseconds(60), -1.0);
  const double q_rad = bench.shaft.position_rad;
  const double v_radps = bench.shaft.velocity_radps;
  EXPECT_GT(std::abs(v_radps), 0.3) << "nothing moves, so nothing is shown of damping";
  const double law_Nm = 5 * (0.4 - q_rad) + 0.5 * (-1.0 - v_radps) + 1.5;
  EXPECT_NEAR(bench.shaft.torque_Nm, law_Nm, 0.2);
}

TEST_P(Impedances, AcceleratesByEffortAlone) {
  CanBench bench(GetParam());
  arm(bench);
  for (const double effort_Nm : {0.8, -0.8}) {
    const double before_radps = bench.shaft.velocity_radps;
    follow(bench, {.effort_Nm = effort_Nm}, milliseconds(100));
    const double gained_radps = bench.shaft.velocity_radps - before_radps;
    EXPECT_NEAR(gained_radps, effort_Nm / bench.inertia_kgm2 * 0.1, 0.25);
  }
}

TEST_P(Impedances, DampsAtRest) {
  CanBench bench(GetParam());
  arm(bench);
  bench.run(milliseconds(1000), AxisRequest::run, 3.0);
  ASSERT_GT(bench.shaft.velocity_radps, 2.5);
  bench.run(milliseconds(1000), AxisRequest::rest);
  EXPECT_NEAR(bench.shaft.velocity_radps, 0.0, 0.02);
  bench.load_Nm = 0.5;
  bench.run(milliseconds(1000), AxisRequest::rest);
  const double creeps_radps = bench.shaft.velocity_radps;
  EXPECT_LT(creeps_radps, 1.0) << "limp, it would be at ten";
  bench.run(milliseconds(2000), AxisRequest::rest);
  EXPECT_NEAR(bench.shaft.velocity_radps, creeps_radps, 0.02) << "damped is not faster with time";
  EXPECT_EQ(bench.motion_at_rest, 0);
}

/// A motor that turns against what it is told drives on what it damps.
TEST_P(Impedances, LetsGoAtOnceOfWhatItsDampingMakesFaster) {
  CanBench bench(GetParam());
  arm(bench);
  bench.run(milliseconds(1000), AxisRequest::run, 1.0);
  ASSERT_NEAR(bench.shaft.velocity_radps, 1.0, 0.1);
  ASSERT_TRUE(bench.twin->set_fault("torque_reversed", bench.now));
  double fastest_radps = 0;
  for (int i = 0; i < 400; ++i) {
    bench.run(milliseconds(5), AxisRequest::idle);
    fastest_radps = std::max(fastest_radps, std::abs(bench.shaft.velocity_radps));
  }
  EXPECT_LT(fastest_radps, 2.0);
  EXPECT_FALSE(bench.shaft.energized && bench.shaft.torque_Nm != 0);
}

TEST_P(Impedances, DampsWhatItIsToLetGoUntilItIsSlow) {
  CanBench bench(GetParam());
  arm(bench);
  bench.run(milliseconds(1000), AxisRequest::run, 3.0);
  ASSERT_GT(bench.shaft.velocity_radps, 2.5);
  bench.run(milliseconds(300), AxisRequest::idle);
  EXPECT_LT(bench.shaft.velocity_radps, 0.3) << "limp, it would be at 2.7";
}

/// Whatever it is told then: it follows from when it says that it runs.
TEST_P(Impedances, DoesNotMoveWhileItIsArmed) {
  CanBench bench(GetParam());
  bench.run(milliseconds(500), AxisRequest::rest);
  bench.law = {.position_rad = 1, .effort_Nm = 1, .stiffness_Nmprad = 100, .damping_Nmsprad = 1};
  for (int i = 0; i < 400 && bench.status.state != AxisState::running; ++i) {
    bench.run(milliseconds(5), AxisRequest::run, 1.0);
    if (bench.status.state == AxisState::running) break;
    ASSERT_LT(std::abs(bench.shaft.torque_Nm), 0.02) << i;
  }
  EXPECT_EQ(bench.status.state, AxisState::running);
}

/// What it was told before it was let go may still stand in it.
TEST_P(Impedances, DoesNotStepBackToWhereItWas) {
  CanBench bench(GetParam());
  arm(bench);
  follow(bench, {.position_rad = 0.5, .stiffness_Nmprad = 50, .damping_Nmsprad = 2},
         milliseconds(1500));
  ASSERT_NEAR(bench.shaft.position_rad, 0.5, 0.01);
  bench.run(milliseconds(2500), AxisRequest::idle);
  ASSERT_EQ(bench.status.state, AxisState::idle);
  bench.shaft.position_rad = -0.5;
  bench.shaft.velocity_radps = 0;
  bench.law = {.damping_Nmsprad = 1};
  for (int i = 0; i < 200; ++i) {
    bench.run(milliseconds(5), AxisRequest::run);
    ASSERT_LT(std::abs(bench.shaft.velocity_radps), 0.02) << i;
  }
  EXPECT_EQ(bench.status.state, AxisState::running);
}

TEST_P(Impedances, HoldsWhereItIsToldTo) {
  CanBench bench(GetParam());
  arm(bench);
  bench.law = {.position_rad = 0.1, .stiffness_Nmprad = 50, .damping_Nmsprad = 2};
  bench.run(milliseconds(1000), AxisRequest::hold);
  bench.load_Nm = 1;
  bench.run(milliseconds(2000), AxisRequest::hold);
  EXPECT_NEAR(bench.shaft.position_rad, 0.1 + 1.0 / 50, 0.003);
}

TEST_P(Impedances, DampsAndCountsWhatIsNoNumber) {
  for (int which = 0; which < 6; ++which) {
    SCOPED_TRACE(which);
    CanBench bench(GetParam());
    arm(bench);
    const std::uint64_t bad = bench.device->health(bench.now).bad;
    bench.sent.clear();
    Setpoint wish = bench.wish(AxisRequest::run, 1.0);
    wish.impedance = {
        .position_rad = 1, .effort_Nm = 0.5, .stiffness_Nmprad = 20, .damping_Nmsprad = 1};
    double* const each[] = {&wish.impedance.position_rad,    &wish.velocity_radps,
                            &wish.impedance.effort_Nm,       &wish.impedance.stiffness_Nmprad,
                            &wish.impedance.damping_Nmsprad, &wish.impedance.stiffness_Nmprad};
    *each[which] = which == 5 ? -20 : kAbsent;
    for (int i = 0; i < 20; ++i) bench.step(wish);
    EXPECT_FALSE(bench.sent.empty());
    for (const CanFrame& frame : bench.sent)
      EXPECT_EQ(bench.effect_of(frame), FrameEffect::stop) << describe(frame);
    EXPECT_GT(bench.device->health(bench.now).bad, bad);
    EXPECT_NEAR(bench.shaft.velocity_radps, 0, 0.02);
  }
}

INSTANTIATE_TEST_SUITE_P(
    Registry, Impedances,
    ::testing::ValuesIn(told(ChannelMode::impedance,
                             subjects_with_twin<MakeCanTwin>(&Made::actuator))),
    label_of);

}  // namespace
}  // namespace drover::test
