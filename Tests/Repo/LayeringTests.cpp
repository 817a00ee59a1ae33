// Who may include whom: the layers of Docs/Architecture.md.
#include <algorithm>
#include <map>
#include <set>
#include <string>

#include <gtest/gtest.h>

#include "Repository.h"

namespace Lantern::Repo
{
namespace
{

using FAllowed = std::map<std::string, std::set<std::string>, std::less<>>;

const FAllowed& GetAllowed()
{
	static const std::set<std::string> Rhi = {"LanternRHI"};
	static const std::set<std::string> Peer = {"LanternRHI", "LanternRHICommon"};
	static const std::set<std::string> Core = {"LanternRHI", "LanternCore"};
	static const std::set<std::string> Scene = {"LanternRHI", "LanternCore", "LanternScene", "LanternSignals"};
	static const std::set<std::string> Module = {"LanternRHI", "LanternRHICommon", "LanternCore", "LanternScene", "LanternRenderer",
	    "LanternRHIVulkan", "LanternRHIValidation", "LanternSignals"};
	static const std::set<std::string> Host = [] {
		std::set<std::string> All = Module;
		All.insert("LanternImage");
		return All;
	}();
	static const std::set<std::string> Measure = [] {
		std::set<std::string> All = Host;
		All.insert("LanternHost");
		return All;
	}();
	static const FAllowed Allowed = {
	    {"LanternRHI", {}},
	    {"LanternRHICommon", Rhi},
	    {"LanternRHIVulkan", Peer},
	    {"LanternRHIMock", Peer},
	    {"LanternRHIValidation", Peer},
	    {"LanternCore", Rhi},
	    {"LanternSignals", Rhi},
	    {"LanternScene", Core},
	    {"LanternRenderer", Scene},
	    {"LanternModule", Module},
	    // Pictures, the sample engine and what is measured with it are not part of the plugin: they may use all of it.
	    {"LanternImage", Core},
	    {"LanternHost", Host},
	    {"LanternMeasure", Measure},
	};
	return Allowed;
}

std::string GetFirstPart(std::string_view Path) { return std::string(Path.substr(0, Path.find('/'))); }

/// The module of a file under Source/, empty for others.
std::string GetModule(const FTextFile& File)
{
	return IsUnder(File, "Source") ? GetFirstPart(std::string_view(File.Path).substr(7)) : std::string();
}

std::vector<std::string> FindUpwardIncludes()
{
	std::vector<std::string> Wrong;
	for (const FTextFile& File : GetFiles())
	{
		const auto Allowed = GetAllowed().find(GetModule(File));
		if (!IsCpp(File) || Allowed == GetAllowed().end()) { continue; }
		for (size_t Line = 0; Line < File.Lines.size(); ++Line)
		{
			const std::string Target = GetFirstPart(GetInclude(File.Lines[Line]));
			const bool bIsModule = GetAllowed().count(Target) != 0 || Target == "Programs" || Target == "Tests";
			if (bIsModule && Target != Allowed->first && Allowed->second.count(Target) == 0)
			{
				Wrong.push_back(At(File, Line) + ": " + Allowed->first + " may not include " + Target);
			}
		}
	}
	return Wrong;
}

std::string Join(const std::vector<std::string>& Lines)
{
	std::string Text;
	for (const std::string& Line : Lines) { Text += "\n  " + Line; }
	return Text;
}

TEST(Layering, EveryModuleIsKnown)
{
	for (const FTextFile& File : GetFiles())
	{
		const std::string Module = GetModule(File);
		if (Module.find('.') == std::string::npos && !Module.empty())
		{
			EXPECT_TRUE(GetAllowed().count(Module)) << Module << ": say in LayeringTests.cpp what it may include";
		}
	}
}

TEST(Layering, TheDocumentNamesEveryModule)
{
	const auto& Files = GetFiles();
	const auto Document =
	    std::find_if(Files.begin(), Files.end(), [](const FTextFile& File) { return File.Path == "Docs/Architecture.md"; });
	ASSERT_NE(Document, Files.end());
	for (const auto& [Module, Allowed] : GetAllowed())
	{
		EXPECT_NE(Document->Text.find("`Source/" + Module + "`"), std::string::npos) << Module << ": it has no row in the table of layers";
	}
}

TEST(Layering, ModulesIncludeOnlyWhatStandsBelow)
{
	const std::vector<std::string> Wrong = FindUpwardIncludes();
	EXPECT_TRUE(Wrong.empty()) << Join(Wrong);
}

TEST(Layering, NoModuleReachesIntoAnothersPrivateFolder)
{
	for (const FTextFile& File : GetFiles())
	{
		for (size_t Line = 0; IsCpp(File) && IsUnder(File, "Source") && Line < File.Lines.size(); ++Line)
		{
			EXPECT_EQ(GetInclude(File.Lines[Line]).find("/Private/"), std::string_view::npos) << At(File, Line);
		}
	}
}

TEST(Layering, RHIHeadersNeedNoVulkanAndNoContainers)
{
	const std::set<std::string_view> Standard = {"cstddef", "cstdint", "new", "type_traits", "utility"};
	size_t Seen = 0;
	for (const FTextFile& File : GetFiles())
	{
		for (size_t Line = 0; IsUnder(File, "Source/LanternRHI/Public") && Line < File.Lines.size(); ++Line)
		{
			const std::string_view Include = GetInclude(File.Lines[Line]);
			if (!Include.empty())
			{
				++Seen;
				EXPECT_TRUE(Standard.count(Include) || GetFirstPart(Include) == "LanternRHI") << At(File, Line);
			}
			EXPECT_EQ(File.Lines[Line].find("std::"), File.Lines[Line].find("std::nullptr_t")) << At(File, Line);
		}
	}
	EXPECT_GT(Seen, 0u) << "found no header to check";
}

// The example engines see what an engine sees.
TEST(Layering, ExampleEnginesKnowOnlyTheModule)
{
	for (const FTextFile& File : GetFiles())
	{
		for (size_t Line = 0;
		     IsCpp(File) && (IsUnder(File, "Programs/EngineFork") || IsUnder(File, "Programs/Minimal")) && Line < File.Lines.size(); ++Line)
		{
			const std::string Target = GetFirstPart(GetInclude(File.Lines[Line]));
			const bool bFine = Target == "LanternModule" || Target == "LanternSignals" || Target == "LanternRHI";
			EXPECT_TRUE(bFine || GetAllowed().count(Target) == 0) << At(File, Line) << " includes " << Target;
		}
	}
}

} // namespace
} // namespace Lantern::Repo
