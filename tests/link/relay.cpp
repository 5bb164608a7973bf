#include "link/relay.hpp"

namespace kestrel::test {

LineCounts operator+(const LineCounts& a, const LineCounts& b) {
  LineCounts sum = a;
  for (long LineCounts::*count :
       {&LineCounts::sent, &LineCounts::lost, &LineCounts::overflowed, &LineCounts::duplicated,
        &LineCounts::corrupted, &LineCounts::truncated, &LineCounts::reordered, &LineCounts::split,
        &LineCounts::delivered}) {
    sum.*count += b.*count;
  }
  return sum;
}

}  // namespace kestrel::test
