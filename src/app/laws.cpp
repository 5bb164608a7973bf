#include <fmt/format.h>

#include "kestrel/servo/law_catalogue.hpp"

#include "compare.hpp"
#include "verbs.hpp"

namespace kestrel::app {

int run(const LawsArguments& a) {
  if (a.law.empty()) {
    for (const Law law : all_laws()) fmt::print("{:14}{}\n", name(law), law_sheet(law).title);
    fmt::print("\n'kestrel laws LAW' says more of one.\n");
    return 0;
  }
  const LawSheet& sheet = law_sheet(*law_named(a.law));
  fmt::print("{}: {}\n\nformula  {}\nneeds    {}\nsource   {}\nuse      {}\nbreaks   {}\n", a.law,
             sheet.title, sheet.formula, sheet.needs, sheet.source, sheet.use, sheet.breaks);
  return 0;
}

}  // namespace kestrel::app
