// Every message that drover-ros2 writes or hears, with another value in each member: the bytes that
// our types (idlc, Cyclone DDS) make of it are those that Fast-CDR makes of the definition, and
// each side reads the other's.
#include <dds/dds.h>
// Behind it:
#include <dds/ddsi/ddsi_serdata.h>

#include <algorithm>
#include <limits>

#include "integration/own_domain.h"
#include "integration/ros2_fastdds_bytes.h"
#include "integration/ros2_fastdds_ours.h"
#include "integration/ros2_user.h"
#include "ros2/topics.h"

namespace drover::test {
namespace {

using fast::Bytes;
using ros2::Topic;

/// Puts another value into each member: texts and lists of changing lengths, so that what follows
/// them begins anywhere.
class Filler {
 public:
  explicit Filler(std::size_t length) : length_(length) {}

  template <fast::Composed M>
  void fill(M& message) {
    std::apply([this](auto&... part) { (fill(part), ...); }, M::parts(message));
  }
  template <class T>
  void fill(std::vector<T>& list) {
    list.resize(length_);
    for (auto& one : list) fill(one);
  }
  void fill(fast::SolidPrimitive& primitive) {
    std::apply([this](auto&... part) { (fill(part), ...); },
               fast::SolidPrimitive::parts(primitive));
    primitive.dimensions.resize(std::min<std::size_t>(length_, 3));
  }
  template <class T, std::size_t kSize>
  void fill(std::array<T, kSize>& list) {
    for (auto& one : list) fill(one);
  }
  void fill(std::string& text) {
    ++next_;
    text = std::string(next_ % 9, 'x') + std::to_string(next_);
  }
  void fill(bool& flag) { flag = true; }
  template <class T>
  requires std::is_integral_v<T>
  void fill(T& number) { number = static_cast<T>(std::is_signed_v<T> ? -++next_ : ++next_); }
  template <class T>
  requires std::is_floating_point_v<T>
  void fill(T& number) {
    number = ++next_ % 7 == 0 ? std::numeric_limits<T>::quiet_NaN()
                              : static_cast<T>(-1.0 / 3) * static_cast<T>(next_);
  }

 private:
  std::size_t length_;
  int next_ = 0;
};

// The same values in our types, member by member by their names.

Bytes bytes_of(const ddsi_serdata* data) {
  Bytes bytes(ddsi_serdata_size(data));
  ddsi_serdata_to_ser(data, 0, bytes.size(), bytes.data());
  return bytes;
}

class Cdr : public ::testing::Test {
 protected:
  Cdr() {
    const auto domain = static_cast<dds_domainid_t>(own_domain_.number());
    dds_ = dds_create_domain(domain, settings_of(User::humble).c_str());
    participant_ = dds_create_participant(domain, nullptr, nullptr);
    EXPECT_GT(participant_, 0);
  }
  ~Cdr() override { dds_delete(dds_); }

  /// As a reader of the same program gets it.
  ddsi_serdata* written(const ros2::TopicKind& kind, const void* sample) {
    const dds_entity_t writer = make_writer(participant_, kind, DDS_RELIABILITY_RELIABLE);
    const dds_entity_t topic =
        dds_create_topic(participant_, kind.type, kind.name, nullptr, nullptr);
    const dds_entity_t reader = dds_create_reader(participant_, topic, nullptr, nullptr);
    EXPECT_EQ(dds_write(writer, sample), DDS_RETCODE_OK);
    ddsi_serdata* data = nullptr;
    dds_sample_info_t info{};
    EXPECT_EQ(dds_takecdr(reader, &data, 1, &info, DDS_ANY_STATE), 1);
    for (const dds_entity_t entity : {reader, topic, writer}) dds_delete(entity);
    return data;
  }
  /// What our type reads out of `bytes`, written again.
  static Bytes read_and_written(const ros2::TopicKind& kind, const ddsi_sertype* type,
                                Bytes bytes) {
    const ddsrt_iovec_t all{bytes.data(), bytes.size()};
    ddsi_serdata* came = ddsi_serdata_from_ser_iov(type, SDK_DATA, 1, &all, bytes.size());
    if (came == nullptr) return {};
    void* sample = dds_alloc(kind.type->m_size);
    EXPECT_TRUE(ddsi_serdata_to_sample(came, sample, nullptr, nullptr));
    ddsi_serdata* again = ddsi_serdata_from_sample(type, SDK_DATA, sample);
    const Bytes out = bytes_of(again);
    dds_sample_free(sample, kind.type, DDS_FREE_ALL);
    ddsi_serdata_unref(again);
    ddsi_serdata_unref(came);
    return out;
  }
  template <class M>
  void expect_equal(const ros2::TopicKind& kind) {
    SCOPED_TRACE(M::kType);
    EXPECT_STREQ(kind.type->m_typename, M::kType);
    for (const std::size_t length : {0U, 1U, 2U, 3U, 7U}) {
      M message;
      Filler(length).fill(message);
      Ours values;
      const auto ours = values.of(message);
      ddsi_serdata* data = written(kind, &ours);
      ASSERT_NE(data, nullptr);
      const Bytes cyclone = bytes_of(data);
      const Bytes by_fast = fast::to_cdr(message);
      expect_same_cdr(cyclone, by_fast);
      // Each reads the other's.
      EXPECT_EQ(read_and_written(kind, data->type, by_fast), cyclone);
      const auto read = fast::from_cdr<M>(cyclone);
      ASSERT_TRUE(read);
      EXPECT_EQ(fast::to_cdr(*read), by_fast);
      ddsi_serdata_unref(data);
    }
  }
  template <class M>
  void expect_equal(Topic topic) {
    expect_equal<M>(ros2::topic_kinds()[static_cast<std::size_t>(topic)]);
  }

 private:
  OwnDomain own_domain_;
  dds_entity_t dds_ = 0;
  dds_entity_t participant_ = 0;
};

TEST_F(Cdr, OfEachTypeIsThatOfFastCdr) {
  expect_equal<fast::JointState>(Topic::joint_states);
  expect_equal<fast::JointStateArray>(Topic::joint_state);
  expect_equal<fast::Imu>(Topic::imu);
  expect_equal<fast::NavSatFix>(Topic::fix);
  expect_equal<fast::Odometry>(Topic::odom);
  expect_equal<fast::PoseWithCovarianceStamped>(Topic::rtk_pose);
  expect_equal<fast::TFMessage>(Topic::tf);
  expect_equal<fast::TFMessage>(Topic::tf_static);
  expect_equal<fast::BatteryState>(Topic::battery_state);
  expect_equal<fast::LaserScan>(Topic::scan);
  expect_equal<fast::DiagnosticArray>(Topic::diagnostics);
  expect_equal<fast::TouchSensorStateArray>(Topic::touch_state);
  static_assert(ros2::kTopicCount == 12);
  expect_equal<fast::Bool>(ros2::stop_kind());
  expect_equal<fast::Twist>(ros2::cmd_vel_kind(false));
  expect_equal<fast::TwistStamped>(ros2::cmd_vel_kind(true));
  expect_equal<fast::JointCommandArray>(ros2::joint_command_kind());
  expect_equal<fast::CollisionObject>(ros2::collision_object_kind());
  expect_equal<fast::Constraints>(ros2::planning_constraints_kind());
}

}  // namespace
}  // namespace drover::test
