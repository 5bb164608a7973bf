#include "support/impairment.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <stdexcept>
#include <string>
#include <utility>

namespace kestrel::test {
namespace {

void require(bool good, const char* option, const char* what) {
  if (!good) throw std::invalid_argument(std::string("impairment: ") + option + " " + what);
}

void require_share(double share, const char* option) {
  require(share >= 0 && share <= 1, option, "must be in [0, 1]");
}

void require_time(double time_s, const char* option) {
  require(time_s >= 0 && std::isfinite(time_s), option, "must be finite and not negative");
}

/// Flips one to eight bits that `chance` chooses, each once: two flips of one are no damage.
void flip_bits(std::vector<std::uint8_t>& piece, std::uint64_t chance) {
  const std::size_t bits = piece.size() * 8;
  std::set<std::size_t> flipped;
  for (const std::size_t wanted = std::min<std::size_t>(1 + chance % 8, bits);
       flipped.size() < wanted;) {
    chance = chance * 6364136223846793005ull + 1442695040888963407ull;  // Knuth's MMIX generator
    const std::size_t bit = (chance >> 16) % bits;
    if (!flipped.insert(bit).second) continue;
    piece[bit / 8] = std::uint8_t(piece[bit / 8] ^ (1u << (bit % 8)));
  }
}

}  // namespace

ImpairmentOptions poor_radio(double loss) {
  ImpairmentOptions line;
  line.loss = loss;
  line.delay_s = 0.06;
  line.jitter_s = 0.04;
  line.reordering = 0.1;
  line.duplication = 0.1;
  line.corruption = 0.05;
  line.truncation = 0.02;
  return line;
}

void ImpairmentOptions::check(Carriage carriage) const {
  require_share(loss, "loss");
  require_share(duplication, "duplication");
  require_share(corruption, "corruption");
  require_share(truncation, "truncation");
  require_share(reordering, "reordering");
  require_share(splitting, "splitting");
  require_time(delay_s, "delay_s");
  require_time(jitter_s, "jitter_s");
  require_time(holdback_s, "holdback_s");
  require_time(retransmission_s, "retransmission_s");
  require_time(queue_s, "queue_s");
  require(bandwidth_bytes_s > 0, "bandwidth_bytes_s", "must be positive");
  if (carriage == Carriage::Datagrams) {
    require(splitting == 0, "splitting", "is for streams");
  } else {
    require(duplication == 0, "duplication", "is for datagrams");
    require(truncation == 0, "truncation", "is for datagrams");
    require(reordering == 0, "reordering", "is for datagrams");
  }
}

ImpairedLine::ImpairedLine(const ImpairmentOptions& options, Carriage carriage,
                           std::string_view name)
    : options_(options), carriage_(carriage), random_(name) {
  options_.check(carriage);
}

void ImpairedLine::send(Bytes piece, double now_s) {
  ++counts_.sent;
  const Draw chance = draw();
  const double starts_s = std::max(now_s, line_free_s_);
  if (carriage_ == Carriage::Datagrams && starts_s - now_s > options_.queue_s) {
    ++counts_.overflowed;
    return;
  }
  line_free_s_ = starts_s + double(piece.size) / options_.bandwidth_bytes_s;
  if (carriage_ == Carriage::Datagrams) {
    send_datagram(damaged(piece, chance), chance, line_free_s_);
  } else {
    send_stream(damaged(piece, chance), chance, line_free_s_);
  }
}

std::vector<ImpairedLine::Piece> ImpairedLine::arrived(double now_s) {
  std::vector<Piece> pieces;
  while (!travelling_.empty() && travelling_.top().arrives_s <= now_s) {
    under_way_bytes_ -= travelling_.top().piece.size();
    pieces.push_back(travelling_.top().piece);
    travelling_.pop();
    ++counts_.delivered;
  }
  return pieces;
}

double ImpairedLine::next_arrival_s() const {
  return travelling_.empty() ? std::numeric_limits<double>::infinity()
                             : travelling_.top().arrives_s;
}

bool ImpairedLine::Travelling::operator<(const Travelling& other) const {
  return std::pair(arrives_s, order) > std::pair(other.arrives_s, other.order);
}

ImpairedLine::Draw ImpairedLine::draw() {
  Draw d{};
  for (double* share : {&d.loss, &d.duplication, &d.corruption, &d.truncation, &d.reordering,
                        &d.splitting, &d.cut}) {
    *share = random_.uniform(0, 1);
  }
  d.jitter = random_.uniform(-1, 1);
  d.jitter_of_copy = random_.uniform(-1, 1);
  d.damage = std::uint64_t(random_.uniform(0, 0x1p53));
  return d;
}

ImpairedLine::Piece ImpairedLine::damaged(Bytes piece, const Draw& draw) {
  Piece copy(piece.begin(), piece.end());
  if (draw.truncation < options_.truncation && !copy.empty()) {
    copy.resize(std::size_t(draw.cut * double(copy.size())));
    ++counts_.truncated;
  }
  if (draw.corruption < options_.corruption) {
    flip_bits(copy, draw.damage);
    ++counts_.corrupted;
  }
  return copy;
}

void ImpairedLine::send_datagram(const Piece& piece, const Draw& draw, double leaves_s) {
  if (draw.duplication < options_.duplication) {
    put(piece, leaves_s + travel_s(draw.jitter_of_copy));
    ++counts_.duplicated;
  }
  if (draw.loss < options_.loss) {
    ++counts_.lost;
    return;
  }
  double arrives_s = leaves_s + travel_s(draw.jitter);
  if (draw.reordering < options_.reordering) {
    arrives_s += options_.holdback_s;
    ++counts_.reordered;
  }
  put(piece, arrives_s);
}

void ImpairedLine::send_stream(const Piece& piece, const Draw& draw, double leaves_s) {
  double arrives_s = leaves_s + travel_s(draw.jitter);
  if (draw.loss < options_.loss) {
    arrives_s += options_.retransmission_s;
    ++counts_.lost;
  }
  last_arrival_s_ = std::max(last_arrival_s_, arrives_s);
  const auto cut = std::ptrdiff_t(draw.cut * double(piece.size()));
  if (draw.splitting < options_.splitting && cut > 0) {
    put(Piece(piece.begin(), piece.begin() + cut), last_arrival_s_);
    put(Piece(piece.begin() + cut, piece.end()), last_arrival_s_);
    ++counts_.split;
  } else {
    put(piece, last_arrival_s_);
  }
}

double ImpairedLine::travel_s(double jitter) const {
  return std::max(0.0, options_.delay_s + options_.jitter_s * jitter);
}

void ImpairedLine::put(Piece piece, double arrives_s) {
  under_way_bytes_ += piece.size();
  travelling_.push({arrives_s, order_++, std::move(piece)});
}

}  // namespace kestrel::test
