#pragma once

#include <string>

#include "kestrel/link/address.hpp"

#include "support/impairment.hpp"

namespace kestrel::test {

/// A bad line between two programs: who sends to `listen` speaks with `to`.
struct RelayOptions {
  Address listen{"127.0.0.1", 0};
  Address to;
  ImpairmentOptions out;       // from those who come to `to`
  ImpairmentOptions back;      // the other way
  std::string name = "relay";  // the seed
};

/// What passed, all conversations together.
struct RelayCounts {
  LineCounts out;
  LineCounts back;
  long conversations = 0;
  long blocked = 0;  // datagrams, or chunks, thrown away while the line was blocked
};

/// The sum, count by count.
LineCounts operator+(const LineCounts& a, const LineCounts& b);

}  // namespace kestrel::test
