// What a chart plans, and how its parts become a page.
#include <fstream>
#include <set>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "LanternMeasure/Chart/ChartParts.h"
#include "LanternMeasure/Chart/ChartPlan.h"
#include "Support/CoreTestTools.h"

namespace Lantern
{
namespace
{

using testing::HasSubstr;

constexpr const char* Registry = "[Method.A]\nSignal=sun_shadow\n+Presets=p:\n+Presets=q:\n"
                                 "[Method.B]\nSignal=frame\n+Presets=r:\n+Presets=s:\n+Presets=t:\n";

FMethods MakeMethods()
{
	FMethods Methods = ParseMethods(Registry, "m.ini");
	EXPECT_TRUE(Methods.Problems.empty());
	return Methods;
}

TEST(ChartPlan, ItemsAreFactsAndThenPathsMethodsPresets)
{
	const std::vector<FChartItem> Items = ListChartItems(MakeMethods(), {});
	ASSERT_EQ(Items.size(), 1u + 4 * 5);
	EXPECT_TRUE(Items[0].bFacts);
	EXPECT_EQ(Items[1].Path, EMeasurePath::Still);
	EXPECT_EQ(Items[5].Method, 1u);
	EXPECT_EQ(Items[5].Preset, 2u);
	EXPECT_EQ(Items[6].Path, EMeasurePath::Slow);
	FChartSelection Selection;
	Selection.Signals = {ESignal::Frame};
	Selection.Paths = {EMeasurePath::Cut};
	EXPECT_EQ(ListChartItems(MakeMethods(), Selection).size(), 1u + 3);
	Selection.Methods = {"A"};
	EXPECT_EQ(ListChartItems(MakeMethods(), Selection).size(), 1u);
}

TEST(ChartPlan, ShardsShareOutAllItems)
{
	EXPECT_FALSE(ParseShard("1"));
	EXPECT_FALSE(ParseShard("0/2"));
	EXPECT_FALSE(ParseShard("3/2"));
	EXPECT_FALSE(ParseShard("1/2x"));
	EXPECT_FALSE(ParseShard("/2"));
	EXPECT_FALSE(ParseShard("-1/2"));
	for (size_t Item = 0; Item < 100; ++Item)
	{
		int Owners = 0;
		for (const char* Text : {"1/3", "2/3", "3/3"}) { Owners += ParseShard(Text)->Has(Item) ? 1 : 0; }
		EXPECT_EQ(Owners, 1);
	}
	EXPECT_TRUE(ParseShard("1/3")->Has(0));
	EXPECT_TRUE(ParseShard("2/3")->Has(4));
}

TEST(ChartPlan, CheapOnesComeFirst)
{
	std::vector<FChartItem> Items = ListChartItems(MakeMethods(), {});
	for (size_t I = 0; I < Items.size(); ++I) { Items[I].Index = I; }
	SortByPrice(Items);
	EXPECT_TRUE(Items[0].bFacts);
	for (size_t I = 2; I < Items.size(); ++I) { EXPECT_LE(Items[I - 1].Preset, Items[I].Preset); }
	EXPECT_EQ(Items[1].Path, EMeasurePath::Still);
	EXPECT_EQ(Items[3].Path, EMeasurePath::Fast);
}

TEST(ChartPlan, SamplesFitTheBudget)
{
	EXPECT_EQ(ChooseSamples(1.0, 100.0, 256), 64u);
	EXPECT_EQ(ChooseSamples(1.0, 1000.0, 256), 256u);
	EXPECT_EQ(ChooseSamples(1.0, 1000.0, 100), 100u);
	EXPECT_EQ(ChooseSamples(1.0, 80.0, 100), 64u);
	EXPECT_EQ(ChooseSamples(1.0, 0.0, 256), 4u);
	EXPECT_EQ(ChooseSamples(1.0, 0.0, 2), 2u);
}

TEST(ChartPlan, KeysDifferWhereMeasurementsDo)
{
	FMethods Methods = MakeMethods();
	const FChartKeyParts Parts{"program", "device", "driver", "scene", {}};
	std::set<std::string> Keys;
	for (const FChartItem& Item : ListChartItems(Methods, {})) { Keys.insert(MakeChartKey(Parts, Methods, Item)); }
	EXPECT_EQ(Keys.size(), 21u);
	const FChartItem Item = ListChartItems(Methods, {})[1];
	const std::string Key = MakeChartKey(Parts, Methods, Item);
	EXPECT_EQ(Key.size(), 32u);
	EXPECT_EQ(MakeChartKey(Parts, MakeMethods(), Item), Key);
	for (std::string FChartKeyParts::*Member :
	    {&FChartKeyParts::Program, &FChartKeyParts::Device, &FChartKeyParts::Driver, &FChartKeyParts::Scene})
	{
		FChartKeyParts Other = Parts;
		Other.*Member += '2';
		EXPECT_NE(MakeChartKey(Other, Methods, Item), Key);
	}
	FChartKeyParts Other = Parts;
	Other.Settings.ReferenceSamples = 7;
	EXPECT_NE(MakeChartKey(Other, Methods, Item), Key);
	// A method that is added leaves the others' parts as they are.
	FMethods More = ParseMethods(std::string(Registry) + "[Method.C]\nSignal=frame\n+Presets=p:\n", "m.ini");
	EXPECT_EQ(MakeChartKey(Parts, More, Item), Key);
	More.Methods[0].Presets[0].Settings.push_back({"x", "1", ""});
	EXPECT_NE(MakeChartKey(Parts, More, Item), Key);
}

FChartPart MakePart(char Key, int Order, const char* Method)
{
	FChartPart Part = {
	    {"version", 1}, {"key", std::string(32, Key)}, {"order", {0, 1, Order, 0}}, {"device", "d"}, {"driver", "v"}, {"is_cpu", true}};
	Part["settings"] = {{"size", "4x4"}};
	Part["scene"] = {{"name", "s"}, {"width", 4}, {"height", 4}};
	Part["signal"] = {{"name", "frame"}, {"title", "Whole frame"}};
	Part["point"] = {
	    {"signal", "frame"}, {"method", Method}, {"preset", "p"}, {"path", "still"}, {"relmse", 0.1 * Order}, {"t90_frames", nullptr}};
	Part["images"] = {{std::string(1, Key), "data:"}};
	return Part;
}

FChartPart MakeSkipped(FChartPart Part)
{
	Part["skipped"] = {{"signal", "frame"}, {"method", Part["point"]["method"]}, {"preset", "p"}, {"path", "still"}, {"reason", "time"}};
	Part.erase("point");
	Part.erase("images");
	return Part;
}

std::string Merge(std::vector<FChartPart> Parts)
{
	nlohmann::json Data;
	const FRTStatus S = MakeChartData(std::move(Parts), Data);
	return S ? Data.dump() : std::string("error: ") + S.Message;
}

TEST(ChartParts, TheirOrderChangesNothing)
{
	const FChartPart A = MakePart('a', 2, "A"), B = MakePart('b', 1, "B"), C = MakePart('c', 3, "C");
	const std::string All = Merge({A, B, C});
	EXPECT_EQ(Merge({C, B, A}), All);
	EXPECT_EQ(Merge({C, A, B, A}), All);
	const nlohmann::json Data = nlohmann::json::parse(All);
	EXPECT_EQ(Data["scenes"][0]["points"][0]["method"], "B");
	EXPECT_EQ(Data["scenes"][0]["points"][2]["method"], "C");
	EXPECT_EQ(Data["images"].size(), 3u);
	EXPECT_FALSE(WithoutImages(Data).contains("images"));
}

TEST(ChartParts, MeasuredGoesBeforeSkipped)
{
	const FChartPart A = MakePart('a', 1, "A");
	EXPECT_EQ(Merge({MakeSkipped(A), A}), Merge({A}));
	EXPECT_EQ(Merge({A, MakeSkipped(A)}), Merge({A}));
	EXPECT_EQ(nlohmann::json::parse(Merge({MakeSkipped(A)}))["scenes"][0]["skipped"][0]["reason"], "time");
}

TEST(ChartParts, WhatDoesNotBelongTogetherIsAnError)
{
	FChartPart B = MakePart('b', 1, "B");
	B["settings"]["size"] = "8x8";
	EXPECT_THAT(Merge({MakePart('a', 1, "A"), B}), HasSubstr("error: parts of different settings"));
	EXPECT_THAT(
	    Merge({MakePart('a', 1, "A"), MakePart('b', 1, "A")}), HasSubstr("error: two different measurements of s: frame, A, p, still"));
	EXPECT_THAT(Merge({}), HasSubstr("error: no part"));
}

TEST(ChartParts, AreKeptAndFound)
{
	const FTemporaryFolder Folder;
	const FChartPart A = MakePart('a', 1, "A");
	EXPECT_TRUE(ReadPart(Folder.GetPath(), A["key"]).is_null());
	ASSERT_TRUE(WritePart(Folder.GetPath(), A));
	EXPECT_EQ(ReadPart(Folder.GetPath(), A["key"]), A);
	// What else lies there, and damaged ones.
	std::ofstream(Folder.GetPath() + "/notes.json") << "{}";
	std::ofstream(GetPartFile(Folder.GetPath(), std::string(32, 'b'))) << "{\"version\": 1, \"key\"";
	std::ofstream(GetPartFile(Folder.GetPath(), std::string(32, 'c'))) << "[]";
	EXPECT_TRUE(ReadPart(Folder.GetPath(), std::string(32, 'b')).is_null());
	std::vector<FChartPart> Parts;
	ASSERT_TRUE(ReadAllParts({Folder.GetPath()}, Parts));
	EXPECT_EQ(Parts.size(), 1u);
	EXPECT_THAT(ReadAllParts({GetPartFile(Folder.GetPath(), std::string(32, 'c'))}, Parts).Message, HasSubstr("not a part of a chart"));
	EXPECT_THAT(ReadAllParts({"/nowhere/x.parts"}, Parts).Message, HasSubstr("/nowhere/x.parts"));
	EXPECT_EQ(ReadAllParts({"/nowhere/x.parts"}, Parts).Code, ERTResult::IoError);
}

} // namespace
} // namespace Lantern
