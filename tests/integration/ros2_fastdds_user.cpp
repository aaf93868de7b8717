// The only file that includes Fast DDS and Fast-CDR: their headers are large.
#include "integration/ros2_fastdds_user.h"

#include <fastcdr/Cdr.h>
#include <fastdds/rtps/transport/UDPv4TransportDescriptor.h>
#include <fastdds/rtps/transport/shared_mem/SharedMemTransportDescriptor.h>
#include <fastrtps/utils/IPLocator.h>
#include <fastdds/dds/domain/DomainParticipant.hpp>
#include <fastdds/dds/domain/DomainParticipantFactory.hpp>
#include <fastdds/dds/publisher/DataWriter.hpp>
#include <fastdds/dds/publisher/Publisher.hpp>
#include <fastdds/dds/subscriber/DataReader.hpp>
#include <fastdds/dds/subscriber/SampleInfo.hpp>
#include <fastdds/dds/subscriber/Subscriber.hpp>
#include <fastdds/dds/topic/TypeSupport.hpp>

#include <algorithm>
#include <cstdlib>
#include <map>
#include <stdexcept>

namespace drover::test::fast {
namespace {

namespace dds = eprosima::fastdds::dds;
namespace rtps = eprosima::fastrtps::rtps;
using eprosima::fastcdr::Cdr;
using eprosima::fastcdr::FastBuffer;

constexpr std::uint32_t kLargest = 64 * 1024;  ///< of a message, as drover-ros2 has it

template <class T>
constexpr bool kIsListOfComposed = false;
template <Composed T>
constexpr bool kIsListOfComposed<std::vector<T>> = true;

template <class T>
void put(Cdr& cdr, const T& value) {
  if constexpr (Composed<T>) {
    std::apply([&](const auto&... part) { (put(cdr, part), ...); }, T::parts(value));
  } else if constexpr (kIsListOfComposed<T>) {
    cdr << static_cast<std::uint32_t>(value.size());
    for (const auto& one : value) put(cdr, one);
  } else {
    cdr << value;
  }
}

template <class T>
void get(Cdr& cdr, T& value) {
  if constexpr (Composed<T>) {
    std::apply([&](auto&... part) { (get(cdr, part), ...); }, T::parts(value));
  } else if constexpr (kIsListOfComposed<T>) {
    std::uint32_t count = 0;
    cdr >> count;
    for (std::uint32_t i = 0; i < count; ++i) get(cdr, value.emplace_back());
  } else {
    cdr >> value;
  }
}

/// One message with the bytes that it came as.
template <class M>
class Type final : public dds::TopicDataType {
 public:
  Type() {
    setName(M::kType);
    m_typeSize = kLargest;
    auto_fill_type_object(false);
    auto_fill_type_information(false);
  }
  bool serialize(void* data, rtps::SerializedPayload_t* payload) override {
    const Bytes bytes = to_cdr(static_cast<Seen<M>*>(data)->message);
    if (bytes.size() > payload->max_size) return false;
    std::copy(bytes.begin(), bytes.end(), payload->data);
    payload->length = static_cast<std::uint32_t>(bytes.size());
    payload->encapsulation = CDR_LE;
    return true;
  }
  bool deserialize(rtps::SerializedPayload_t* payload, void* data) override {
    auto& seen = *static_cast<Seen<M>*>(data);
    seen.bytes.assign(payload->data, payload->data + payload->length);
    auto message = from_cdr<M>(seen.bytes);
    if (message) seen.message = std::move(*message);
    return message.has_value();
  }
  std::function<std::uint32_t()> getSerializedSizeProvider(void* data) override {
    return [data] {
      return static_cast<std::uint32_t>(to_cdr(static_cast<Seen<M>*>(data)->message).size());
    };
  }
  void* createData() override { return new Seen<M>; }
  void deleteData(void* data) override { delete static_cast<Seen<M>*>(data); }
  bool getKey(void*, rtps::InstanceHandle_t*, bool) override { return false; }
};

/// As rmw_fastrtps does it, but for what `quality` says.
template <class Qos>
void put_quality(Qos& qos, const Quality& quality) {
  qos.reliability().kind =
      quality.reliable ? dds::RELIABLE_RELIABILITY_QOS : dds::BEST_EFFORT_RELIABILITY_QOS;
  qos.durability().kind =
      quality.for_later ? dds::TRANSIENT_LOCAL_DURABILITY_QOS : dds::VOLATILE_DURABILITY_QOS;
  qos.history().kind = dds::KEEP_LAST_HISTORY_QOS;
  qos.history().depth = 10;
  qos.endpoint().history_memory_policy = rtps::PREALLOCATED_WITH_REALLOC_MEMORY_MODE;
  qos.data_sharing().off();
  if (quality.deadline_s > 0)
    qos.deadline().period = eprosima::fastrtps::Duration_t(quality.deadline_s);
  if (quality.exclusive) qos.ownership().kind = dds::EXCLUSIVE_OWNERSHIP_QOS;
}

template <class M>
class FastReader final : public Reader<M> {
 public:
  FastReader(dds::Subscriber* of, dds::Topic* topic, const dds::DataReaderQos& qos)
      : of_(of), reader_(of->create_datareader(topic, qos)) {
    if (reader_ == nullptr) throw std::runtime_error("no Fast DDS reader");
  }
  ~FastReader() override { of_->delete_datareader(reader_); }
  std::optional<Seen<M>> newest() override {
    std::optional<Seen<M>> newest;
    Seen<M> next;
    dds::SampleInfo info;
    while (reader_->take_next_sample(&next, &info) == ReturnCode_t::RETCODE_OK)
      if (info.valid_data) newest = next;
    return newest;
  }
  int writers() const override {
    dds::SubscriptionMatchedStatus status;
    reader_->get_subscription_matched_status(status);
    return status.current_count;
  }
  int refused() const override {
    dds::RequestedIncompatibleQosStatus status;
    reader_->get_requested_incompatible_qos_status(status);
    return static_cast<int>(status.total_count);
  }

 private:
  dds::Subscriber* of_;
  dds::DataReader* reader_;
};

template <class M>
class FastWriter final : public Writer<M> {
 public:
  FastWriter(dds::Publisher* of, dds::Topic* topic, const dds::DataWriterQos& qos)
      : of_(of), writer_(of->create_datawriter(topic, qos)) {
    if (writer_ == nullptr) throw std::runtime_error("no Fast DDS writer");
  }
  ~FastWriter() override { of_->delete_datawriter(writer_); }
  bool write(const M& message) override {
    Seen<M> sample{message, {}};
    return writer_->write(&sample);
  }
  int readers() const override {
    dds::PublicationMatchedStatus status;
    writer_->get_publication_matched_status(status);
    return status.current_count;
  }
  int refused() const override {
    dds::OfferedIncompatibleQosStatus status;
    writer_->get_offered_incompatible_qos_status(status);
    return static_cast<int>(status.total_count);
  }

 private:
  dds::Publisher* of_;
  dds::DataWriter* writer_;
};

/// rmw_fastrtps of Humble and ROS_LOCALHOST_ONLY=1: multicast, on loopback alone.
void put_humble(dds::DomainParticipantQos& qos) {
  qos.transport().use_builtin_transports = false;
  const auto loopback = std::make_shared<eprosima::fastdds::rtps::UDPv4TransportDescriptor>();
  loopback->interfaceWhiteList.emplace_back("127.0.0.1");
  qos.transport().user_transports = {
      loopback, std::make_shared<eprosima::fastdds::rtps::SharedMemTransportDescriptor>()};
}

/// rmw_fastrtps of Jazzy and ROS_AUTOMATIC_DISCOVERY_RANGE=LOCALHOST: no multicast is listened to,
/// 32 programs are looked for on loopback.
void put_jazzy(dds::DomainParticipantQos& qos) {
  qos.transport().use_builtin_transports = false;
  const auto udp = std::make_shared<eprosima::fastdds::rtps::UDPv4TransportDescriptor>();
  udp->maxInitialPeersRange = 32;
  qos.transport().user_transports = {
      std::make_shared<eprosima::fastdds::rtps::SharedMemTransportDescriptor>(), udp};
  auto& builtin = qos.wire_protocol().builtin;
  builtin.metatrafficUnicastLocatorList.push_back(rtps::Locator_t());
  rtps::Locator_t peer;
  rtps::IPLocator::setIPv4(peer, "127.0.0.1");
  builtin.initialPeersList.push_back(peer);
}

}  // namespace

struct User::Parts {
  dds::DomainParticipant* participant = nullptr;
  dds::Publisher* publisher = nullptr;
  dds::Subscriber* subscriber = nullptr;
  std::map<std::string, dds::Topic*> topics;

  template <class M>
  dds::Topic* topic(const std::string& name) {
    const dds::TypeSupport type(new Type<M>);
    type.register_type(participant);
    auto*& topic = topics[name + M::kType];
    if (topic == nullptr)
      topic = participant->create_topic(name, type.get_type_name(), dds::TOPIC_QOS_DEFAULT);
    return topic;
  }
};

User::User(int domain, Told told, const std::string& file) : parts_(std::make_unique<Parts>()) {
  auto* factory = dds::DomainParticipantFactory::get_instance();
  // As rmw_fastrtps does it.
  if (told == Told::by_our_file) ::setenv("FASTRTPS_DEFAULT_PROFILES_FILE", file.c_str(), 1);
  if (factory->load_profiles() != ReturnCode_t::RETCODE_OK)
    throw std::runtime_error("Fast DDS does not read " + file);
  auto qos = factory->get_default_participant_qos();
  if (told == Told::by_humble) put_humble(qos);
  if (told == Told::by_jazzy) put_jazzy(qos);
  parts_->participant = factory->create_participant(static_cast<std::uint32_t>(domain), qos);
  if (parts_->participant == nullptr) throw std::runtime_error("no Fast DDS participant");
  parts_->publisher = parts_->participant->create_publisher(dds::PUBLISHER_QOS_DEFAULT);
  parts_->subscriber = parts_->participant->create_subscriber(dds::SUBSCRIBER_QOS_DEFAULT);
}

User::~User() {
  parts_->participant->delete_contained_entities();
  dds::DomainParticipantFactory::get_instance()->delete_participant(parts_->participant);
}

template <class M>
std::unique_ptr<Reader<M>> User::reader(const std::string& topic, const Quality& quality) {
  dds::DataReaderQos qos;
  put_quality(qos, quality);
  return std::make_unique<FastReader<M>>(parts_->subscriber, parts_->topic<M>(topic), qos);
}

template <class M>
std::unique_ptr<Writer<M>> User::writer(const std::string& topic, const Quality& quality) {
  dds::DataWriterQos qos;
  put_quality(qos, quality);
  return std::make_unique<FastWriter<M>>(parts_->publisher, parts_->topic<M>(topic), qos);
}

template <class M>
Bytes to_cdr(const M& message) {
  // Fast-CDR leaves what lies between members as it was.
  Bytes bytes(kLargest);
  FastBuffer buffer(reinterpret_cast<char*>(bytes.data()), bytes.size());
  Cdr cdr(buffer, Cdr::LITTLE_ENDIANNESS, Cdr::DDS_CDR);
  cdr.serialize_encapsulation();
  put(cdr, message);
  bytes.resize(cdr.getSerializedDataLength());
  return bytes;
}

template <class M>
std::optional<M> from_cdr(const Bytes& bytes) {
  Bytes own = bytes;
  FastBuffer buffer(reinterpret_cast<char*>(own.data()), own.size());
  Cdr cdr(buffer, Cdr::DEFAULT_ENDIAN, Cdr::DDS_CDR);
  try {
    M message;
    cdr.read_encapsulation();
    get(cdr, message);
    return message;
  } catch (const eprosima::fastcdr::exception::Exception&) {
    return std::nullopt;
  }
}

// Each type once, here.
#define DROVER_FAST_TYPE(M)                                                                \
  template std::unique_ptr<Reader<M>> User::reader<M>(const std::string&, const Quality&); \
  template std::unique_ptr<Writer<M>> User::writer<M>(const std::string&, const Quality&); \
  template Bytes to_cdr(const M&);                                                         \
  template std::optional<M> from_cdr(const Bytes&)
DROVER_FAST_TYPE(BatteryState);
DROVER_FAST_TYPE(Bool);
DROVER_FAST_TYPE(CollisionObject);
DROVER_FAST_TYPE(Constraints);
DROVER_FAST_TYPE(DiagnosticArray);
DROVER_FAST_TYPE(Imu);
DROVER_FAST_TYPE(JointCommandArray);
DROVER_FAST_TYPE(JointState);
DROVER_FAST_TYPE(JointStateArray);
DROVER_FAST_TYPE(LaserScan);
DROVER_FAST_TYPE(NavSatFix);
DROVER_FAST_TYPE(Odometry);
DROVER_FAST_TYPE(PoseWithCovarianceStamped);
DROVER_FAST_TYPE(TFMessage);
DROVER_FAST_TYPE(TouchSensorStateArray);
DROVER_FAST_TYPE(Twist);
DROVER_FAST_TYPE(TwistStamped);
#undef DROVER_FAST_TYPE

}  // namespace drover::test::fast
