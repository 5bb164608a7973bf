#pragma once

#include <string>
#include <vector>

#include "kestrel/io/report.hpp"
#include "kestrel/io/summary.hpp"

namespace kestrel {

/// A column of a table: its name for programs (with its unit) and how many digits behind the point
/// a reader wants of it.
struct Column {
  std::string name;
  int digits = 0;
};

/// Rows of as many values as there are columns; a number that is not finite is one that is missing.
struct Table {
  std::vector<Column> columns;
  std::vector<std::vector<SummaryValue>> rows;
};

/// As CSV (RFC 4180, lines end with \n), numbers in full precision, missing ones empty.
std::string csv(const Table& table);

/// As a JSON list of objects, a row each, in full precision, missing numbers null; indented by
/// `indent` spaces.
std::string json(const Table& table, int indent);

/// The table for a reader: numbers rounded to their column's digits, an en dash for missing ones,
/// underscores of names as spaces, units in brackets.
ReportTable readable(const Table& table);

/// A readable table as lines for a terminal, columns aligned.
std::string aligned(const ReportTable& table);

}  // namespace kestrel
