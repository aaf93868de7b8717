#include "runtime/mqtt_client.h"

#include <mosquitto.h>
#include <sys/random.h>

#include <algorithm>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <optional>
#include <stdexcept>

namespace drover::runtime {

namespace {

constexpr Duration kFirstBrokerPause = std::chrono::milliseconds(250);
constexpr Duration kLongestBrokerPause = std::chrono::seconds(2);
constexpr int kQosAnswers = 1;
constexpr const char* kOnlineTopic = "drover/online";

std::string random_client_id() {
  std::uint32_t number = 0;
  // Two robots with one id would throw each other off the broker for ever.
  (void)!::getrandom(&number, sizeof number, GRND_NONBLOCK);
  char text[32];
  std::snprintf(text, sizeof text, "droverd-%08x", number);
  return text;
}

/// Nothing when there is no file, or nothing in it (it is being written).
std::optional<std::string> read_password(const std::string& path) {
  std::ifstream file(path);
  std::string password;
  if (!file || !std::getline(file, password)) return std::nullopt;
  return password;
}

}  // namespace

MqttClient::MqttClient(const config::MqttConfig& config,
                       std::vector<MqttSubscription> subscriptions, OnMessage on_message,
                       OnState on_state)
    : config_(config),
      subscriptions_(std::move(subscriptions)),
      on_message_(std::move(on_message)),
      on_state_(std::move(on_state)) {
  ::mosquitto_lib_init();
  const auto id = config_.client_id.empty() ? random_client_id() : config_.client_id;
  // Clean session: a start that was queued while we were away must never be replayed.
  client_ = ::mosquitto_new(id.c_str(), true, this);
  if (client_ == nullptr) throw std::runtime_error("mqtt.client_id: not accepted: " + id);
  ::mosquitto_int_option(client_, MOSQ_OPT_TCP_NODELAY, 1);
  ::mosquitto_will_set(client_, kOnlineTopic, 1, "0", kQosAnswers, true);
  ::mosquitto_connect_callback_set(client_, [](mosquitto*, void* self, int code) {
    auto& me = *static_cast<MqttClient*>(self);
    if (code != 0) return me.on_state_(false, ::mosquitto_connack_string(code));
    me.connected_ = true;
    me.connecting_ = false;
    me.pause_ = kFirstBrokerPause;
    me.last_text_.clear();
    for (const auto& [topic, qos] : me.subscriptions_)
      ::mosquitto_subscribe(me.client_, nullptr, topic.c_str(), qos);
    ::mosquitto_publish(me.client_, nullptr, kOnlineTopic, 1, "1", kQosAnswers, true);
    me.on_state_(true, "connected to the broker");
  });
  ::mosquitto_disconnect_callback_set(client_, [](mosquitto*, void* self, int) {
    auto& me = *static_cast<MqttClient*>(self);
    me.connected_ = me.connecting_ = false;
  });
  ::mosquitto_message_callback_set(
      client_, [](mosquitto*, void* self, const mosquitto_message* message) {
        const std::string_view payload(static_cast<const char*>(message->payload),
                                       static_cast<std::size_t>(message->payloadlen));
        static_cast<MqttClient*>(self)->on_message_({message->topic, payload, message->retain});
      });
}

MqttClient::~MqttClient() {
  if (connected_) {
    ::mosquitto_publish(client_, nullptr, kOnlineTopic, 1, "0", kQosAnswers, true);
    for (int i = 0; i < 10 && ::mosquitto_want_write(client_); ++i)
      ::mosquitto_loop_write(client_, 1);
  }
  ::mosquitto_destroy(client_);
  ::mosquitto_lib_cleanup();
}

int MqttClient::fd() const {
  return ::mosquitto_socket(client_);
}

bool MqttClient::wants_write() const {
  return fd() >= 0 && ::mosquitto_want_write(client_);
}

void MqttClient::on_readable() {
  if (const int code = ::mosquitto_loop_read(client_, 1); code != MOSQ_ERR_SUCCESS) failed(code);
}

void MqttClient::on_writable() {
  if (const int code = ::mosquitto_loop_write(client_, 1); code != MOSQ_ERR_SUCCESS) failed(code);
}

void MqttClient::failed(int code) {
  failed(code == MOSQ_ERR_ERRNO ? std::strerror(errno) : ::mosquitto_strerror(code));
}

void MqttClient::failed(const std::string& why) {
  const bool was_connected = connected_;
  connected_ = connecting_ = false;
  const auto text = "broker " + config_.host + ":" + std::to_string(config_.port) + ": " + why;
  if (was_connected || text != last_text_) on_state_(false, text);  // once, not each try
  last_text_ = text;
}

void MqttClient::tick(Time now) {
  if (fd() >= 0) {
    if (const int code = ::mosquitto_loop_misc(client_); code != MOSQ_ERR_SUCCESS) failed(code);
    return;
  }
  if (connected_ || connecting_) failed(MOSQ_ERR_CONN_LOST);
  if (now >= next_try_) connect(now);
}

void MqttClient::connect(Time now) {
  pause_ = std::clamp(pause_ * 2, kFirstBrokerPause, kLongestBrokerPause);
  next_try_ = now + pause_;
  if (!config_.username.empty()) {
    // Read at each try: who sets up the broker may write the file after droverd was started.
    const std::optional<std::string> password =
        config_.password_file.empty() ? std::string() : read_password(config_.password_file);
    if (!password) return failed("mqtt.password_file: cannot read " + config_.password_file);
    ::mosquitto_username_pw_set(client_, config_.username.c_str(), password->c_str());
  }
  ++connections_;
  const int code =
      ::mosquitto_connect_async(client_, config_.host.c_str(), config_.port, config_.keepalive_s);
  if (code == MOSQ_ERR_SUCCESS) {
    connecting_ = true;
  } else {
    failed(code);
  }
}

bool MqttClient::publish_latest(const char* topic, const std::string& payload) {
  if (!connected_ || wants_write()) {
    ++dropped_;
    return false;
  }
  return ::mosquitto_publish(client_, nullptr, topic, static_cast<int>(payload.size()),
                             payload.data(), 0, false) == MOSQ_ERR_SUCCESS;
}

bool MqttClient::publish(const char* topic, const std::string& payload, bool retained) {
  if (!connected_) return false;
  return ::mosquitto_publish(client_, nullptr, topic, static_cast<int>(payload.size()),
                             payload.data(), kQosAnswers, retained) == MOSQ_ERR_SUCCESS;
}

}  // namespace drover::runtime
