#pragma once

#include <atomic>
#include <condition_variable>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "kestrel/io/live_source.hpp"
#include "kestrel/io/picture_queue.hpp"

namespace kestrel {

/// The thread of a LiveSource: reads pictures into the queue and opens the camera again when it
/// fails.
struct LiveSource::Reader {
  Reader(std::string named, OpenCamera opens, const LiveOptions& wanted, FirstOpening first);
  ~Reader();
  Reader(const Reader&) = delete;
  Reader& operator=(const Reader&) = delete;

  LiveStatus status() const;
  /// The sentences since the last call.
  std::vector<std::string> take_words();

  PictureQueue queue;

 private:
  std::unique_ptr<CameraDevice> open_first(FirstOpening first);
  void run();
  void read_until_it_fails();
  bool open_again(int attempt);
  void keep(Picture picture);
  std::string fault_of(const Picture& picture);
  void pause(double seconds);
  void say(const std::string& words);
  void disconnected(const std::string& why);

  const std::string address_;
  const OpenCamera open_;
  const LiveOptions options_;
  std::atomic<bool> stop_{false};
  mutable std::mutex mutex_;  // guards status_ and words_
  std::condition_variable stopped_;
  LiveStatus status_;
  std::vector<std::string> words_;

  // The thread's own once it runs.
  std::unique_ptr<CameraDevice> camera_;
  cv::Size size_;  // of the first picture
  std::string last_fault_;
  std::int64_t pending_lost_ = 0;  // pictures before the next whole one
  double last_picture_s_;          // when the last one came, or the camera was opened
  double last_whole_s_;
  std::thread thread_;  // the last member: it starts when all else is there
};

}  // namespace kestrel
