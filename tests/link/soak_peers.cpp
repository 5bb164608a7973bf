#include "link/soak_peers.hpp"

#include <cmath>
#include <limits>
#include <system_error>

#include "kestrel/link/setpoint.hpp"

#include "link/samples.hpp"

namespace kestrel::test {
namespace {

void send_datagram(const Descriptor& socket, Bytes bytes) {
  ::send(socket.get(), bytes.data, bytes.size, MSG_NOSIGNAL | MSG_DONTWAIT);
}

}  // namespace

int Rate::due(double now_s) {
  if (next_s_ < 0 || now_s - next_s_ > 1) next_s_ = now_s;
  int count = 0;
  for (; next_s_ <= now_s; next_s_ += period_s_) ++count;
  return count;
}

SoakFlight::SoakFlight(const CommandLimits& envelope)
    : socket_(bound_socket({"127.0.0.1", 0}, SOCK_DGRAM)), limit_(envelope.speed) {}

void SoakFlight::turn(double now_s) {
  for (ReadResult got = read_some(socket_); got.bytes; got = read_some(socket_)) {
    switch_ = got.from;
    judge(*got.bytes, now_s);
  }
  for (int i = attitude_.due(now_s); i > 0; --i) {
    mavlink::AttitudeReport attitude;
    attitude.time_boot_ms = time_boot_ms(now_s);
    attitude.yaw_rad = float(std::fmod(now_s, 3));
    send(attitude);
  }
  for (int i = heartbeat_.due(now_s); i > 0; --i) send(mavlink::Heartbeat{});
}

void SoakFlight::judge(const std::vector<std::uint8_t>& datagram, double now_s) {
  ++frames_;
  const mavlink::Decoded decoded = mavlink::decode({datagram.data(), datagram.size()});
  const auto* packet = std::get_if<mavlink::Packet>(&decoded.content);
  if (packet == nullptr) {
    ++wrong_;
    return;
  }
  const auto* setpoint = std::get_if<mavlink::SetPositionTarget>(&packet->message);
  if (setpoint == nullptr) return;
  ++setpoints_;
  const auto velocity = velocity_of(*setpoint);
  const bool good = velocity && velocity->down_m_s == 0 &&
                    (velocity->vector().array().abs() <= limit_.vector().array()).all();
  if (!good) ++wrong_;
  if (velocity && !velocity->vector().isZero(0)) ++moves_;
  if (last_setpoint_s_ > 0) longest_gap_s_ = std::max(longest_gap_s_, now_s - last_setpoint_s_);
  last_setpoint_s_ = now_s;
}

void SoakFlight::send(const mavlink::Message& message) {
  if (!switch_) return;
  const auto frame = mavlink::encode(message, {1, 1, sequence_++});
  sendto(socket_.get(), frame.data.data(), frame.size, MSG_NOSIGNAL, switch_->get(), switch_->size);
}

SoakSource::SoakSource(const Address& to, std::uint8_t component_id, const VelocityCommand& command,
                       double rate_hz)
    : socket_(connected_socket(to, SOCK_DGRAM)),
      component_id_(component_id),
      command_(command),
      setpoints_(rate_hz) {}

void SoakSource::turn(double now_s) {
  while (read_some(socket_).bytes) {
  }
  const auto say = [&](const mavlink::Message& message) {
    send_datagram(socket_, mavlink::encode(message, {1, component_id_, sequence_++}).bytes());
    ++sent_;
  };
  for (int i = setpoints_.due(now_s); i > 0; --i) {
    say(velocity_setpoint(command_, time_boot_ms(now_s), {}));
  }
  for (int i = heartbeats_.due(now_s); i > 0; --i) say(mavlink::Heartbeat{});
}

SoakGround::SoakGround(const Address& to, std::uint8_t system_id, Reads reads)
    : to_(to), system_id_(system_id), reads_(reads) {}

void SoakGround::turn(double now_s) {
  if (!socket_ && now_s >= retry_s_) connect();
  if (!socket_) return;
  for (int i = heartbeats_.due(now_s); i > 0; --i) send(mavlink::Heartbeat{});
  for (int i = requests_.due(now_s); i > 0; --i) {
    mavlink::CommandLong request;  // MAV_CMD_SET_MESSAGE_INTERVAL
    request.command = 511;
    request.param1 = 30;
    request.param2 = 100000;
    request.target_system = request.target_component = 1;
    send(request);
  }
  while (reads_ == Reads::All) {
    const ReadResult got = read_some(*socket_);
    if (got.broken || (got.bytes && got.bytes->empty())) {
      socket_.reset();
      retry_s_ = now_s + 0.05;
      return;
    }
    if (!got.bytes) return;
    read_bytes_ += long(got.bytes->size());
  }
}

void SoakGround::connect() {
  try {
    socket_ = connected_socket(to_, SOCK_STREAM);
    ++connections_;
  } catch (const std::system_error&) {
    // refused: again later
  }
}

void SoakGround::send(const mavlink::Message& message) {
  const auto frame = mavlink::encode(message, {system_id_, 190, sequence_++});
  ::send(socket_->get(), frame.data.data(), frame.size, MSG_NOSIGNAL | MSG_DONTWAIT);
}

SoakHostile::SoakHostile(const Address& to, std::string_view seed, double rate_hz)
    : to_(to), random_(seed), rate_(rate_hz) {}

void SoakHostile::turn(double now_s) {
  for (int i = rate_.due(now_s); i > 0; --i, ++sent_) {
    if (sent_ % 200 == 0) socket_ = connected_socket(to_, SOCK_DGRAM);
    while (read_some(*socket_).bytes) {
    }
    const auto bytes = bad_input(now_s);
    send_datagram(*socket_, {bytes.data(), bytes.size()});
  }
}

std::vector<std::uint8_t> SoakHostile::bad_input(double now_s) {
  const mavlink::Envelope from{1, 191, random_byte(random_)};  // the companion's own ids
  auto setpoint = velocity_setpoint({0, 0, 0.5, 0}, time_boot_ms(now_s), {});
  switch (random_.integer(0, 5)) {
    case 0: {
      Buffer noise(std::size_t(random_.integer(0, 600)));
      for (auto& byte : noise) byte = random_byte(random_);
      return noise;
    }
    case 1:
      return random_frame(random_);
    case 2:
      setpoint.vx_m_s = std::numeric_limits<float>::quiet_NaN();
      break;
    case 3:
      setpoint.coordinate_frame = random_byte(random_) | 0x10;
      break;
    case 4: {
      Buffer cut = copy(mavlink::encode(setpoint, from).bytes());
      cut.resize(std::size_t(random_.integer(1, int(cut.size()) - 1)));
      return cut;
    }
    default:
      return copy(mavlink::encode(setpoint, {0, 191, 0}).bytes());
  }
  return copy(mavlink::encode(setpoint, from).bytes());
}

}  // namespace kestrel::test
