#pragma once

#include <atomic>
#include <functional>
#include <string>
#include <thread>

#include <httplib.h>

#include "kestrel/ground/stream_frame.hpp"
#undef _res  // a macro of resolv.h

namespace kestrel::bench {

/// How a viewer takes what it is sent.
struct Appetite {
  double bytes_per_s = 0;  // 0: as fast as it comes
  bool takes = true;       // false: it opens the stream and takes nothing
};

/// A page that looks on, in a thread of its own, until it ends. Each frame is handed to look.
class Viewer {
 public:
  Viewer(int port, std::string bearer, const Appetite& appetite,
         std::function<void(const StreamFrame&)> look)
      : thread_([this, port, bearer = std::move(bearer), appetite, look = std::move(look)] {
          watch(port, bearer, appetite, look);
        }) {}
  ~Viewer() {
    done_ = true;
    thread_.join();
  }
  Viewer(const Viewer&) = delete;
  Viewer& operator=(const Viewer&) = delete;

 private:
  void watch(int port, const std::string& bearer, const Appetite& appetite,
             const std::function<void(const StreamFrame&)>& look) {
    httplib::Client client("127.0.0.1", port);
    client.set_read_timeout(5);
    client.set_socket_options([](socket_t socket) {
      // What a slow line holds is in its modem, not in megabytes of this kernel.
      const int bytes = 16 << 10;
      setsockopt(socket, SOL_SOCKET, SO_RCVBUF, &bytes, sizeof bytes);
    });
    StreamReader reader;
    while (!done_) {
      client.Get("/stream", {{"Authorization", bearer}}, [&](const char* data, std::size_t size) {
        while (!appetite.takes && !done_) nap(0.05);
        if (appetite.bytes_per_s > 0) nap(double(size) / appetite.bytes_per_s);
        reader.add({data, size});
        while (const auto frame = reader.next()) look(*frame);
        return !done_;
      });
      reader = {};
      nap(0.05);
    }
  }
  static void nap(double s) { std::this_thread::sleep_for(std::chrono::duration<double>(s)); }

  std::atomic<bool> done_{false};
  std::thread thread_;
};

}  // namespace kestrel::bench
