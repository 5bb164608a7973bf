#include "kestrel/io/module.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/temp_folder.hpp"

namespace kestrel {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

TEST(Module, IsTheSameWhoeverAsks) {
  const void* const table = module_table("images");
  EXPECT_NE(table, nullptr);
  EXPECT_EQ(module_table("images"), table);
}

TEST(Module, SaysWhichFileIsMissing) {
  EXPECT_THAT(test::message_of([] { module_table("none"); }),
              AllOf(HasSubstr("kestrel_none.so: "), HasSubstr("cannot open shared object"),
                    HasSubstr("keep it beside the program")));
}

}  // namespace
}  // namespace kestrel
