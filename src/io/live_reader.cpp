#include "live_reader.hpp"

#include <algorithm>
#include <chrono>
#include <stdexcept>

#include <fmt/format.h>

namespace kestrel {
namespace {

constexpr std::size_t kMostWords = 200;  // that wait to be taken

}  // namespace

LiveSource::Reader::Reader(std::string named, OpenCamera opens, const LiveOptions& wanted,
                           FirstOpening first)
    : queue(wanted.queue_pictures),
      address_(std::move(named)),
      open_(std::move(opens)),
      options_(wanted),
      camera_(open_first(first)),
      last_picture_s_(monotonic_clock_s()),
      last_whole_s_(last_picture_s_) {
  status_.connections = 1;
  status_.clock = camera_->clock();
  thread_ = std::thread([this] { run(); });
}

LiveSource::Reader::~Reader() {
  stop_ = true;
  {
    const std::lock_guard<std::mutex> lock(mutex_);  // none may be between its test and its wait
  }
  stopped_.notify_all();
  thread_.join();
}

std::unique_ptr<CameraDevice> LiveSource::Reader::open_first(FirstOpening first) {
  const double last_s = monotonic_clock_s() + options_.open_timeout_s;
  for (int attempt = 0;; ++attempt) {
    try {
      return open_([this] { return stop_.load(); }, last_s - monotonic_clock_s());
    } catch (const std::runtime_error&) {
      const double delay_s = retry_delay_s(attempt, options_);
      if (first == FirstOpening::Once || monotonic_clock_s() + delay_s >= last_s) throw;
      pause(delay_s);
    }
  }
}

void LiveSource::Reader::run() {
  while (!stop_) {
    read_until_it_fails();
    camera_.reset();
    for (int attempt = 0; !stop_ && !open_again(attempt); ++attempt) {
    }
  }
}

void LiveSource::Reader::read_until_it_fails() {
  last_picture_s_ = monotonic_clock_s();  // a new connection gets its whole time
  try {
    while (!stop_) {
      std::optional<Picture> picture = camera_->next();
      if (stop_) return;
      if (picture) {
        keep(std::move(*picture));
      } else if (monotonic_clock_s() - last_picture_s_ > options_.stall_timeout_s) {
        return disconnected(address_ + ": " + camera_->silence(options_.stall_timeout_s));
      }
    }
  } catch (const std::exception& error) {
    disconnected(error.what());
  }
}

bool LiveSource::Reader::open_again(int attempt) {
  pause(retry_delay_s(attempt, options_));
  if (stop_) return false;
  try {
    camera_ = open_([this] { return stop_.load(); }, options_.open_timeout_s);
  } catch (const std::exception& error) {
    const std::lock_guard<std::mutex> lock(mutex_);
    status_.trouble = error.what();
    return false;
  }
  const std::lock_guard<std::mutex> lock(mutex_);
  ++status_.connections;
  status_.clock = camera_->clock();
  status_.trouble.clear();
  return true;
}

/// Why a picture cannot be used; empty when it can.
std::string LiveSource::Reader::fault_of(const Picture& picture) {
  if (picture.gray.empty()) return picture.damage.empty() ? "came damaged" : picture.damage;
  if (size_.empty()) size_ = picture.gray.size();
  if (picture.gray.size() == size_) return "";
  return fmt::format(
      "is of {} x {} px, the first was of {} x {}: calibration and template hold for "
      "that size; set it back, or start anew",
      picture.gray.cols, picture.gray.rows, size_.width, size_.height);
}

void LiveSource::Reader::keep(Picture picture) {
  const double now_s = monotonic_clock_s();
  pending_lost_ += picture.lost;
  const std::string fault = fault_of(picture);
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    status_.lost += picture.lost;
    status_.clock = camera_->clock();  // a camera may learn from its pictures what they are worth
    if (fault.empty()) {
      status_.longest_silence_s = std::max(status_.longest_silence_s, now_s - last_whole_s_);
      ++status_.captured;
      last_whole_s_ = now_s;
    } else {
      ++status_.damaged;
      ++pending_lost_;
    }
  }
  // A picture of the wrong size says that the camera is there: it must not be taken for silent.
  last_picture_s_ = now_s;
  if (!fault.empty() && fault != last_fault_) say(fmt::format("{}: a picture {}", address_, fault));
  last_fault_ = fault;
  if (!fault.empty()) return;
  picture.lost = pending_lost_;
  pending_lost_ = 0;
  queue.put(std::move(picture));
}

void LiveSource::Reader::disconnected(const std::string& why) {
  say(why + "; connecting again");
  const std::lock_guard<std::mutex> lock(mutex_);
  status_.trouble = why;
}

void LiveSource::Reader::say(const std::string& words) {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (words_.size() < kMostWords) words_.push_back(words);
}

void LiveSource::Reader::pause(double seconds) {
  std::unique_lock<std::mutex> lock(mutex_);
  stopped_.wait_for(lock, std::chrono::duration<double>(seconds), [this] { return stop_.load(); });
}

LiveStatus LiveSource::Reader::status() const {
  LiveStatus status;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    status = status_;
  }
  status.dropped = queue.dropped();
  return status;
}

std::vector<std::string> LiveSource::Reader::take_words() {
  const std::lock_guard<std::mutex> lock(mutex_);
  std::vector<std::string> words;
  words.swap(words_);
  return words;
}

}  // namespace kestrel
