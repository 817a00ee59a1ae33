// How the compiler lays out the types of a namespace, as text: sizes, offsets, values of enums, and the order of virtual calls.
#pragma once

#include <string>
#include <vector>

namespace Lantern::Abi
{

/// DebugInfo: what "readelf --debug-dump=info --wide" prints of an object. Types of Namespace and of those within come in the
/// order of their names, one block of lines each. Templates are left out, because their instances depend on their users.
std::vector<std::string> DescribeLayouts(const std::string& DebugInfo, const std::string& Namespace);

/// Runs readelf on an object and describes it. Empty if that fails.
std::vector<std::string> DescribeObject(const std::string& ObjectFile, const std::string& Namespace);

} // namespace Lantern::Abi
