#include "runtime/mqtt_client.h"

#include <mosquitto.h>
#include <mqtt_protocol.h>
#include <sys/ioctl.h>
#include <sys/random.h>
#include <sys/stat.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <optional>
#include <stdexcept>

#include "runtime/log.h"

namespace drover::runtime {

namespace {

constexpr int kQosAnswers = 1;
constexpr const char* kOnlineTopic = "drover/online";
constexpr std::size_t kMostUnacknowledged = 200;
/// Packets that are read before others in the loop have their turn.
constexpr int kMostPackets = 64;
constexpr std::size_t kMostBytes = std::size_t{256} << 10;  // but a packet is never cut
constexpr int kMqtt31Refused = 1;  // CONNACK of 3.1.1: unacceptable protocol version

std::string random_client_id() {
  std::uint32_t number = 0;
  // Two robots with one id would throw each other off the broker for ever.
  (void)!::getrandom(&number, sizeof number, GRND_NONBLOCK);
  char text[32];
  std::snprintf(text, sizeof text, "droverd-%08x", number);
  return text;
}

struct Password {
  std::string text;
  std::string problem;  ///< empty: it was read
  bool everybody_reads = false;
};

/// An empty file may be one that is being written.
Password read_password(const std::string& path) {
  errno = 0;
  std::ifstream file(path);
  Password password;
  struct stat is = {};
  if (!file || ::stat(path.c_str(), &is) != 0)
    password.problem = "cannot read " + path + ": " + std::strerror(errno);
  else if (S_ISDIR(is.st_mode))
    password.problem = path + " is a folder";
  else if (!std::getline(file, password.text) || password.text.empty())
    password.problem = path + " is empty";
  password.everybody_reads = (is.st_mode & S_IROTH) != 0;
  return password;
}

MqttClient& self(void* object) {
  return *static_cast<MqttClient*>(object);
}

}  // namespace

MqttClient::MqttClient(const config::MqttConfig& config,
                       std::vector<MqttSubscription> subscriptions, OnMessage on_message,
                       OnState on_state, Presence presence)
    : config_(config),
      subscriptions_(std::move(subscriptions)),
      on_message_(std::move(on_message)),
      on_state_(std::move(on_state)),
      tells_presence_(presence == Presence::told) {
  ::mosquitto_lib_init();
  auto id = config_.client_id.empty() ? random_client_id() : config_.client_id;
  // The broker lets nobody in twice by one name.
  if (!tells_presence_) id += "-stop";
  // Clean session: a start that was queued while we were away must never be replayed.
  client_ = ::mosquitto_new(id.c_str(), true, this);
  if (client_ == nullptr) throw std::runtime_error("mqtt.client_id: not accepted: " + id);
  ::mosquitto_int_option(client_, MOSQ_OPT_TCP_NODELAY, 1);
  speak(MQTT_PROTOCOL_V5);
  if (tells_presence_) ::mosquitto_will_set(client_, kOnlineTopic, 1, "0", kQosAnswers, true);
  set_callbacks();
}

void MqttClient::set_callbacks() {
  ::mosquitto_connect_callback_set(
      client_, [](mosquitto*, void* object, int code) { self(object).on_connack(code); });
  // Of the reasons only a broker's own are worth telling; failed() follows, or the next tick.
  ::mosquitto_disconnect_callback_set(client_, [](mosquitto*, void* object, int code) {
    auto& me = self(object);
    if (code >= MQTT_RC_UNSPECIFIED && me.refusal_.empty())
      me.refusal_ = ::mosquitto_reason_string(code);
  });
  ::mosquitto_publish_callback_set(client_, [](mosquitto*, void* object, int message) {
    self(object).on_acknowledged(message);
  });
  ::mosquitto_message_callback_set(
      client_, [](mosquitto*, void* object, const mosquitto_message* message) {
        auto& me = self(object);
        const std::string_view payload(static_cast<const char*>(message->payload),
                                       static_cast<std::size_t>(message->payloadlen));
        me.bytes_taken_ += payload.size();
        // 3.1.1 sets the flag on stored messages only; with 5, those were asked to stay away.
        const auto flagged =
            me.version_ == MQTT_PROTOCOL_V5 ? publish::Retain::asked : publish::Retain::stored;
        me.on_message_({message->topic, payload, message->retain ? flagged : publish::Retain::no});
      });
}

MqttClient::~MqttClient() {
  if (connected_ && tells_presence_) {
    ::mosquitto_publish(client_, nullptr, kOnlineTopic, 1, "0", kQosAnswers, true);
    for (int i = 0; i < 10 && ::mosquitto_want_write(client_); ++i)
      ::mosquitto_loop_write(client_, 1);
  }
  ::mosquitto_destroy(client_);
  ::mosquitto_lib_cleanup();
}

void MqttClient::speak(int version) {
  version_ = version;
  ::mosquitto_int_option(client_, MOSQ_OPT_PROTOCOL_VERSION, version);
}

namespace {

/// In the broker's words, and where to mend it: the two keys are what it has to go by.
std::string refused_with(int code, bool newest) {
  std::string words = newest ? ::mosquitto_reason_string(code) : ::mosquitto_connack_string(code);
  const bool of_the_user =
      newest
          ? code == MQTT_RC_NOT_AUTHORIZED || code == MQTT_RC_BAD_USERNAME_OR_PASSWORD
          : code == CONNACK_REFUSED_NOT_AUTHORIZED || code == CONNACK_REFUSED_BAD_USERNAME_PASSWORD;
  if (of_the_user) words += " (mqtt.username, mqtt.password_file)";
  return words;
}

}  // namespace

void MqttClient::on_connack(int code) {
  closed_unanswered_ = 0;
  if (code == 0) return on_connected();
  if (version_ == MQTT_PROTOCOL_V5 &&
      (code == MQTT_RC_UNSUPPORTED_PROTOCOL_VERSION || code == kMqtt31Refused)) {
    speak(MQTT_PROTOCOL_V311);
    retry_.try_now();
    refusal_ = "it knows no MQTT 5";
    return;
  }
  refusal_ = refused_with(code, version_ == MQTT_PROTOCOL_V5);
}

void MqttClient::on_connected() {
  connected_ = true;
  connecting_ = false;
  retry_.succeeded();
  last_text_.clear();
  delay_.on_connected(asked_, now_);
  const bool newest = version_ == MQTT_PROTOCOL_V5;
  for (const auto& [topic, qos] : subscriptions_) {
    const int options = MQTT_SUB_OPT_RETAIN_AS_PUBLISHED | MQTT_SUB_OPT_SEND_RETAIN_NEVER;
    ::mosquitto_subscribe_v5(client_, nullptr, topic.c_str(), qos, newest ? options : 0, nullptr);
  }
  if (tells_presence_)
    ::mosquitto_publish(client_, nullptr, kOnlineTopic, 1, "1", kQosAnswers, true);
  on_state_(true, newest ? "connected to the broker"
                         : "connected to the broker, which speaks MQTT 3.1.1 only: a start that is "
                           "published with retain cannot be told from others");
}

void MqttClient::on_acknowledged(int message) {
  if (const auto answer = unacknowledged_.find(message); answer != unacknowledged_.end()) {
    bytes_under_way_ -= answer->second;
    unacknowledged_.erase(answer);
  }
  delay_.on_acknowledged(message, now_);
}

int MqttClient::fd() const {
  return ::mosquitto_socket(client_);
}

bool MqttClient::wants_write() const {
  return fd() >= 0 && ::mosquitto_want_write(client_);
}

void MqttClient::on_readable(Time now) {
  now_ = now;
  int waiting = 0;
  int packets = 0;
  bytes_taken_ = 0;
  do {
    if (const int code = ::mosquitto_loop_read(client_, 1); code != MOSQ_ERR_SUCCESS)
      return failed(code);
    waiting = 0;
  } while (++packets < kMostPackets && bytes_taken_ < kMostBytes && fd() >= 0 &&
           ::ioctl(fd(), FIONREAD, &waiting) == 0 && waiting > 0);
}

void MqttClient::on_writable(Time now) {
  now_ = now;
  if (const int code = ::mosquitto_loop_write(client_, 1); code != MOSQ_ERR_SUCCESS) failed(code);
}

void MqttClient::failed(int code) {
  const std::string why = !refusal_.empty()        ? refusal_
                          : code == MOSQ_ERR_ERRNO ? std::strerror(errno)
                                                   : ::mosquitto_strerror(code);
  refusal_.clear();
  // A broker that knows no MQTT 5 may just close. One that goes down may, too: twice is a habit.
  const bool unanswered = connecting_ && (code == MOSQ_ERR_CONN_LOST || code == MOSQ_ERR_PROTOCOL ||
                                          code == MOSQ_ERR_MALFORMED_PACKET);
  const bool older = version_ != MQTT_PROTOCOL_V5;
  if (unanswered && ++closed_unanswered_ >= 2) {
    closed_unanswered_ = 0;
    speak(older ? MQTT_PROTOCOL_V5 : MQTT_PROTOCOL_V311);
  } else if (connected_ && older) {
    speak(MQTT_PROTOCOL_V5);  // it may have been replaced by a newer one
  }
  failed(why);
}

void MqttClient::failed(const std::string& why) {
  const bool was_connected = connected_;
  connected_ = connecting_ = false;
  const auto text = "broker " + config_.host + ":" + std::to_string(config_.port) + ": " + why;
  if (was_connected || text != last_text_) on_state_(false, text);  // once, not each try
  last_text_ = text;
}

void MqttClient::tick(Time now) {
  now_ = now;
  if (auto answer = lookup_.take()) {
    if (!answer->addresses.empty()) {
      // The first answer is waited for; a later one is for the next try.
      if (addresses_.empty()) retry_.try_now();
      addresses_ = std::move(answer->addresses);
    } else if (!connected_ && addresses_.empty()) {
      failed(answer->problem);
    }
  }
  if (fd() >= 0) {
    if (const int code = ::mosquitto_loop_misc(client_); code != MOSQ_ERR_SUCCESS)
      return failed(code);
    int message = 0;
    if (connected_ && tells_presence_ && delay_.due(now) &&
        ::mosquitto_publish(client_, &message, kOnlineTopic, 1, "1", kQosAnswers, false) ==
            MOSQ_ERR_SUCCESS)
      delay_.on_sent(message, now);
    return;
  }
  if (connected_ || connecting_) failed(MOSQ_ERR_CONN_LOST);
  if (retry_.due(now)) connect(now);
}

/// Read at each try: who sets up the broker may write the file after droverd was started.
bool MqttClient::read_credentials() {
  if (config_.username.empty()) return true;
  const Password password =
      config_.password_file.empty() ? Password{} : read_password(config_.password_file);
  if (!password.problem.empty()) {
    failed("mqtt.password_file: " + password.problem);
    return false;
  }
  if (password.everybody_reads && tells_presence_ && !open_file_told_) {
    open_file_told_ = true;
    log(LogLevel::warning, "mqtt.password_file: everybody on this computer may read " +
                               config_.password_file + " (chgrp drover and chmod 0640 close it)");
  }
  ::mosquitto_username_pw_set(client_, config_.username.c_str(), password.text.c_str());
  return true;
}

/// Each of the host's addresses in turn; empty while none is known. The library gets no name: it
/// would wait for the name server.
std::string MqttClient::next_address() {
  if (is_numeric(config_.host)) return config_.host;
  const bool waited = lookup_.under_way();
  lookup_.ask(config_.host);
  if (!addresses_.empty()) return addresses_[next_address_++ % addresses_.size()];
  if (waited) failed("the name server does not answer");
  return {};
}

void MqttClient::connect(Time now) {
  retry_.tried(now);
  if (!read_credentials()) return;
  const auto address = next_address();
  if (address.empty()) return;
  ++connections_;
  asked_ = now;
  refusal_.clear();
  const int code =
      ::mosquitto_connect_async(client_, address.c_str(), config_.port, config_.keepalive_s);
  if (code == MOSQ_ERR_SUCCESS) {
    connecting_ = true;
  } else {
    failed(code);
  }
}

bool MqttClient::publish_latest(const char* topic, const std::string& payload) {
  const bool taken = connected_ && !wants_write() &&
                     ::mosquitto_publish(client_, nullptr, topic, static_cast<int>(payload.size()),
                                         payload.data(), 0, false) == MOSQ_ERR_SUCCESS;
  if (!taken) ++dropped_;
  return taken;
}

std::string_view MqttClient::publish(const char* topic, const std::string& payload, bool retained) {
  if (!connected_ || unacknowledged_.size() >= kMostUnacknowledged) {
    ++dropped_;
    return connected_ ? "the broker acknowledges nothing" : "the broker is gone";
  }
  int message = 0;
  const int code = ::mosquitto_publish(client_, &message, topic, static_cast<int>(payload.size()),
                                       payload.data(), kQosAnswers, retained);
  if (code == MOSQ_ERR_OVERSIZE_PACKET) return "the broker takes no message of this size";
  if (code != MOSQ_ERR_SUCCESS) return ::mosquitto_strerror(code);
  unacknowledged_[message] = payload.size();
  bytes_under_way_ += payload.size();
  return {};
}

}  // namespace drover::runtime
