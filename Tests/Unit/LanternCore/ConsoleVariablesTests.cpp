#include <cmath>
#include <optional>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "LanternCore/Config/ConsoleVariables.h"
#include "Support/CoreTestTools.h"

namespace Lantern
{
namespace
{

using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

TRTConsoleVariable<bool> CVarToggle("t.Core.Toggle", true, "A toggle.");
TRTConsoleVariable<int32_t> CVarSamples("t.Core.Shadow.Samples", 1, "Rays | per pixel.\nSecond line.", {1, 64});
TRTConsoleVariable<float> CVarDistance("t.Core.Shadow.Distance", 0.1f, "Metres.", {0.0, 1000.0});
TRTConsoleVariable<int32_t> CVarFreeInt("t.Core.FreeInt", 0, "No range.");
TRTConsoleVariable<float> CVarFreeFloat("t.Core.FreeFloat", 0.0f, "At least -1.", {-1.0});
TRTConsoleVariable<std::string> CVarName("t.Core.Name", "plain", "A text.");

class ConsoleVariables : public testing::Test
{
protected:
	ConsoleVariables() { Restore(); }
	~ConsoleVariables() override { Restore(); }

	static void Restore()
	{
		FConsoleVariables::Get().ResetAll();
		FConsoleVariables::Get().BeginFrame();
	}
	static std::optional<std::string> Set(std::string_view Name, std::string_view Value, ERTSetBy By = ERTSetBy::CommandLine)
	{
		return FConsoleVariables::Get().Set(Name, Value, By, "--set");
	}

	FConsoleVariables& Registry = FConsoleVariables::Get();
	FLogCapture Log;
};

TEST_F(ConsoleVariables, StartWithTheirDefaults)
{
	EXPECT_EQ(CVarToggle.Get(), true);
	EXPECT_EQ(CVarSamples.Get(), 1);
	EXPECT_EQ(CVarDistance.GetOnRenderThread(), 0.1f);
	EXPECT_EQ(CVarName.GetOnRenderThread(), "plain");
	EXPECT_EQ(CVarName.GetSetBy(), ERTSetBy::Code);
	EXPECT_EQ(std::get<int32_t>(CVarSamples.GetDefault()), 1);
	EXPECT_EQ(CVarSamples.GetRange().Max, 64.0);
}

TEST_F(ConsoleVariables, RenderThreadSeesAValueOnlyFromTheNextFrameOn)
{
	EXPECT_FALSE(Set("t.Core.Shadow.Samples", "8"));
	EXPECT_EQ(CVarSamples.Get(), 8);
	EXPECT_EQ(CVarSamples.GetOnRenderThread(), 1);
	Registry.BeginFrame();
	EXPECT_EQ(CVarSamples.GetOnRenderThread(), 8);
}

TEST_F(ConsoleVariables, NamesIgnoreCaseAndBlanksAround)
{
	EXPECT_FALSE(Set(" T.CORE.shadow.samples ", " 7 "));
	EXPECT_EQ(CVarSamples.Get(), 7);
	EXPECT_EQ(Registry.Find("t.core.TOGGLE"), &CVarToggle);
}

TEST_F(ConsoleVariables, BoolTakesTheFourSpellingsAndUEsWords)
{
	for (const char* Text : {"0", "false", "False", "off", "no"})
	{
		EXPECT_FALSE(Set("t.Core.Toggle", "1"));
		EXPECT_FALSE(Set("t.Core.Toggle", Text)) << Text;
		EXPECT_FALSE(CVarToggle.Get()) << Text;
	}
	for (const char* Text : {"1", "true", "TRUE", "on", "yes"})
	{
		EXPECT_FALSE(Set("t.Core.Toggle", "0"));
		EXPECT_FALSE(Set("t.Core.Toggle", Text)) << Text;
		EXPECT_TRUE(CVarToggle.Get()) << Text;
	}
}

TEST_F(ConsoleVariables, NumbersInAllTheirForms)
{
	EXPECT_FALSE(Set("t.Core.FreeInt", "-12"));
	EXPECT_EQ(CVarFreeInt.Get(), -12);
	EXPECT_FALSE(Set("t.Core.FreeInt", "+5"));
	EXPECT_EQ(CVarFreeInt.Get(), 5);
	EXPECT_FALSE(Set("t.Core.FreeInt", "3.0"));
	EXPECT_EQ(CVarFreeInt.Get(), 3);
	EXPECT_FALSE(Set("t.Core.FreeInt", "True")); // as ini files of UE write ints
	EXPECT_EQ(CVarFreeInt.Get(), 1);
	EXPECT_FALSE(Set("t.Core.FreeFloat", "2.5e-3"));
	EXPECT_FLOAT_EQ(CVarFreeFloat.Get(), 0.0025f);
	EXPECT_FALSE(Set("t.Core.FreeInt", "2147483647"));
	EXPECT_EQ(CVarFreeInt.Get(), 2147483647);
	EXPECT_EQ(Log.Count(ERTLogLevel::Warning), 0u);
}

struct FWrongValue
{
	const char *Name, *Value, *Reason;
};

TEST_F(ConsoleVariables, AWrongValueIsOneWarningAndChangesNothing)
{
	const FWrongValue Cases[] = {
	    {"t.Core.Toggle", "2", "is not a bool"},
	    {"t.Core.Toggle", "", "is not a bool"},
	    {"t.Core.Toggle", "maybe", "is not a bool"},
	    {"t.Core.Shadow.Samples", "1.5", "is not a whole number"},
	    {"t.Core.Shadow.Samples", "four", "is not a whole number"},
	    {"t.Core.Shadow.Samples", "4 5", "is not a whole number"},
	    {"t.Core.Shadow.Samples", "", "is not a whole number"},
	    {"t.Core.Shadow.Samples", "+-4", "is not a whole number"},
	    {"t.Core.Shadow.Distance", "nan", "is not a number"},
	    {"t.Core.Shadow.Distance", "inf", "is not a number"},
	    {"t.Core.Shadow.Distance", "1e999", "is not a number"},
	    {"t.Core.Shadow.Distance", "1,5", "is not a number"},
	};
	for (const FWrongValue& Case : Cases)
	{
		const size_t Before = Log.Count(ERTLogLevel::Warning);
		const std::optional<std::string> Message = Set(Case.Name, Case.Value);
		ASSERT_TRUE(Message) << Case.Name << "=" << Case.Value;
		EXPECT_THAT(*Message, HasSubstr(Case.Reason));
		EXPECT_THAT(*Message, HasSubstr(Case.Name));
		EXPECT_THAT(*Message, testing::StartsWith("--set: "));
		EXPECT_EQ(Log.Count(ERTLogLevel::Warning), Before + 1);
		EXPECT_EQ(Log.GetTexts().back(), *Message);
		EXPECT_EQ(Registry.Find(Case.Name)->GetValue(), Registry.Find(Case.Name)->GetDefault());
		EXPECT_EQ(Registry.Find(Case.Name)->GetSetBy(), ERTSetBy::Code);
	}
	EXPECT_THAT(*Set("t.Core.Shadow.Samples", "x"), HasSubstr("range: 1 to 64"));
}

TEST_F(ConsoleVariables, AnUnknownNameNamesTheNearest)
{
	EXPECT_THAT(*Set("t.Core.Shadw.Samples", "1"), HasSubstr("the nearest name is 't.Core.Shadow.Samples'"));
	EXPECT_THAT(*Set("t.core.toggel", "1"), HasSubstr("'t.Core.Toggle'"));
	EXPECT_THAT(*Set("", "1"), HasSubstr("unknown console variable ''"));
	Registry.AddAlias("q.OtherEngine.Setting", "t.Core.Toggle");
	EXPECT_THAT(*Set("q.OtherEngin.Setting", "1"), HasSubstr("'q.OtherEngine.Setting'"));
	EXPECT_EQ(Log.Count(ERTLogLevel::Warning), 4u);
}

TEST_F(ConsoleVariables, AHostileNameOrValueMakesAShortPrintableMessage)
{
	const std::string Huge(10'000'000, 'x');
	const std::string Control("a\0b\x1b[31m\n", 9);
	for (const std::optional<std::string>& Message :
	    {Set(Huge, "1"), Set("t.Core.Toggle", Huge), Set(Control, "1"), Set("t.Core.FreeInt", Control)})
	{
		ASSERT_TRUE(Message);
		EXPECT_LT(Message->size(), 300u);
		EXPECT_TRUE(std::all_of(Message->begin(), Message->end(), [](char C) { return static_cast<unsigned char>(C) >= 0x20; }));
	}
}

TEST_F(ConsoleVariables, OutOfRangeIsClampedWithOneWarning)
{
	EXPECT_FALSE(Set("t.Core.Shadow.Samples", "1000"));
	EXPECT_EQ(CVarSamples.Get(), 64);
	ASSERT_EQ(Log.Count(ERTLogLevel::Warning), 1u);
	EXPECT_THAT(Log.GetTexts()[0], HasSubstr("--set: t.Core.Shadow.Samples: '1000' is out of range (1 to 64); 64"));
	// A slider held against its end is not reported every frame …
	for (int Frame = 0; Frame < 10; ++Frame) EXPECT_FALSE(Set("t.Core.Shadow.Samples", std::to_string(2000 + Frame)));
	EXPECT_EQ(Log.Count(ERTLogLevel::Warning), 1u);
	// … but at its other end, and after it was right in between, it is.
	EXPECT_FALSE(Set("t.Core.Shadow.Samples", "-5"));
	EXPECT_EQ(CVarSamples.Get(), 1);
	EXPECT_EQ(Log.Count(ERTLogLevel::Warning), 2u);
	EXPECT_FALSE(Set("t.Core.Shadow.Samples", "5"));
	EXPECT_FALSE(Set("t.Core.Shadow.Samples", "0"));
	EXPECT_EQ(Log.Count(ERTLogLevel::Warning), 3u);
}

TEST_F(ConsoleVariables, NumbersBeyondTheirTypeAreClamped)
{
	EXPECT_FALSE(Set("t.Core.FreeInt", "99999999999999999999"));
	EXPECT_EQ(CVarFreeInt.Get(), INT32_MAX);
	EXPECT_FALSE(Set("t.Core.FreeInt", "-3e9"));
	EXPECT_EQ(CVarFreeInt.Get(), INT32_MIN);
	EXPECT_FALSE(Set("t.Core.FreeFloat", "1e300"));
	EXPECT_TRUE(std::isfinite(CVarFreeFloat.Get()));
	EXPECT_FALSE(Set("t.Core.FreeFloat", "-7"));
	EXPECT_EQ(CVarFreeFloat.Get(), -1.0f);
	EXPECT_EQ(Log.Count(ERTLogLevel::Warning), 4u);
}

TEST_F(ConsoleVariables, AHigherSetterWinsWhateverTheOrder)
{
	const ERTSetBy All[] = {
	    ERTSetBy::Code, ERTSetBy::Ini, ERTSetBy::Scalability, ERTSetBy::DeviceProfile, ERTSetBy::CommandLine, ERTSetBy::Console};
	for (const ERTSetBy First : All)
	{
		for (const ERTSetBy Second : All)
		{
			Restore();
			EXPECT_FALSE(Set("t.Core.FreeInt", "1", First));
			EXPECT_FALSE(Set("t.Core.FreeInt", "2", Second)) << "a refusal by rank is no error";
			const bool bSecondWins = Second >= First;
			EXPECT_EQ(CVarFreeInt.Get(), bSecondWins ? 2 : 1) << ToString(First) << ", " << ToString(Second);
			EXPECT_EQ(CVarFreeInt.GetSetBy(), bSecondWins ? Second : First);
		}
	}
	EXPECT_EQ(Log.Count(ERTLogLevel::Warning), 0u);
	EXPECT_FALSE(Set("t.Core.Shadow.Samples", "2", ERTSetBy::Console));
	EXPECT_FALSE(Set("t.Core.Shadow.Samples", "1000", ERTSetBy::Ini));
	EXPECT_EQ(Log.Count(ERTLogLevel::Warning), 0u) << "what is not used is not clamped";
	EXPECT_TRUE(Set("t.Core.Shadow.Samples", "many", ERTSetBy::Ini)) << "what is wrong is wrong at any rank";
}

TEST_F(ConsoleVariables, CallbackRunsOncePerFrameAndOnlyAfterAChange)
{
	int Calls = 0;
	int32_t Seen = 0;
	CVarFreeInt.SetCallback([&](const FRTConsoleVariable& Variable) {
		++Calls;
		EXPECT_EQ(&Variable, &CVarFreeInt);
		Seen = CVarFreeInt.GetOnRenderThread();
	});
	Registry.BeginFrame();
	EXPECT_EQ(Calls, 0);
	EXPECT_FALSE(Set("t.Core.FreeInt", "3"));
	EXPECT_FALSE(Set("t.Core.FreeInt", "4"));
	EXPECT_EQ(Calls, 0);
	Registry.BeginFrame();
	EXPECT_EQ(Calls, 1);
	EXPECT_EQ(Seen, 4);
	EXPECT_FALSE(Set("t.Core.FreeInt", "5"));
	EXPECT_FALSE(Set("t.Core.FreeInt", "4")); // there and back within a frame
	Registry.BeginFrame();
	EXPECT_EQ(Calls, 1);
	CVarFreeInt.SetCallback({});
	EXPECT_FALSE(Set("t.Core.FreeInt", "6"));
	Registry.BeginFrame();
	EXPECT_EQ(Calls, 1);
}

TEST_F(ConsoleVariables, ACallbackMaySetVariablesForTheNextFrame)
{
	CVarFreeInt.SetCallback([&](const FRTConsoleVariable&) { EXPECT_FALSE(Set("t.Core.Name", "changed")); });
	EXPECT_FALSE(Set("t.Core.FreeInt", "9"));
	Registry.BeginFrame();
	EXPECT_EQ(CVarName.GetOnRenderThread(), "plain");
	Registry.BeginFrame();
	EXPECT_EQ(CVarName.GetOnRenderThread(), "changed");
	CVarFreeInt.SetCallback({});
}

TEST_F(ConsoleVariables, ALogSinkMayAskForVariables)
{
	int32_t Seen = 0;
	SetLogSink([&](ERTLogLevel, std::string_view) { Seen = CVarSamples.Get(); });
	EXPECT_FALSE(Set("t.Core.Shadow.Samples", "100"));
	EXPECT_EQ(Seen, 64);
	SetLogSink({});
}

TEST_F(ConsoleVariables, AliasesLeadToTheirVariableAlsoInSteps)
{
	Registry.AddAlias("x.Old.Samples", "t.Core.Shadow.Samples");
	Registry.AddAlias("x.Older.Samples", "X.OLD.SAMPLES");
	EXPECT_EQ(Registry.Find("X.older.samples"), &CVarSamples);
	EXPECT_FALSE(Set("x.Older.Samples", "3"));
	EXPECT_EQ(CVarSamples.Get(), 3);
	EXPECT_THAT(Registry.GetAliases(), testing::Contains(testing::Pair("x.Old.Samples", "t.Core.Shadow.Samples")));
}

TEST_F(ConsoleVariables, AliasesMayCountInOtherUnits)
{
	Registry.AddAlias("x.Centi.Samples", "t.Core.Shadow.Samples", 0.01);
	Registry.AddAlias("x.Milli.Samples", "x.Centi.Samples", 0.1);
	EXPECT_FALSE(Set("x.Centi.Samples", "1200"));
	EXPECT_EQ(CVarSamples.Get(), 12);
	EXPECT_FALSE(Set("x.Milli.Samples", "3400"));
	EXPECT_EQ(CVarSamples.Get(), 3) << "rounded";
	EXPECT_FALSE(Set("x.Centi.Samples", "1e9"));
	EXPECT_EQ(CVarSamples.Get(), 64) << "the range is the variable's";
	EXPECT_TRUE(Set("x.Centi.Samples", "many"));
	EXPECT_FALSE(Set("t.Core.Shadow.Samples", "5"));
	EXPECT_EQ(CVarSamples.Get(), 5);
}

TEST_F(ConsoleVariables, AliasesInACircleOrToNothingAreUnknownNames)
{
	Registry.AddAlias("x.Circle.A", "x.Circle.B");
	Registry.AddAlias("x.Circle.B", "x.Circle.A");
	Registry.AddAlias("x.Self", "x.Self");
	Registry.AddAlias("x.Dangling", "t.Core.NotThere");
	for (const char* Name : {"x.Circle.A", "x.Self", "x.Dangling"})
	{
		EXPECT_EQ(Registry.Find(Name), nullptr);
		EXPECT_TRUE(Set(Name, "1"));
	}
}

TEST_F(ConsoleVariables, AVariableIsKnownWhileItLives)
{
	{
		TRTConsoleVariable<int32_t> Short("t.Core.ShortLived", 1, "");
		EXPECT_FALSE(Set("t.Core.ShortLived", "2")); // still waiting for BeginFrame when it dies
		EXPECT_EQ(Registry.Find("t.Core.ShortLived"), &Short);
	}
	EXPECT_EQ(Registry.Find("t.Core.ShortLived"), nullptr);
	Registry.BeginFrame();
}

TEST_F(ConsoleVariables, AllAreListedInOrderOfNames)
{
	std::vector<std::string> Names;
	for (const FRTConsoleVariable* Variable : Registry.GetAll())
		if (Variable->GetName().rfind("t.Core.", 0) == 0) Names.push_back(Variable->GetName());
	EXPECT_THAT(Names, ElementsAre("t.Core.FreeFloat", "t.Core.FreeInt", "t.Core.Name", "t.Core.Shadow.Distance", "t.Core.Shadow.Samples",
	                       "t.Core.Toggle"));
}

TEST_F(ConsoleVariables, JsonHoldsEveryField)
{
	Registry.AddAlias("x.Json.Samples", "t.Core.Shadow.Samples");
	EXPECT_FALSE(Set("t.Core.Shadow.Samples", "5", ERTSetBy::Ini));
	EXPECT_FALSE(Set("t.Core.Name", "not UTF-8: \xff"));
	const nlohmann::json Root = nlohmann::json::parse(Registry.ToJson());
	nlohmann::json Samples, Distance, Name;
	for (const nlohmann::json& Entry : Root.at("variables"))
	{
		if (Entry.at("name") == "t.Core.Shadow.Samples") Samples = Entry;
		if (Entry.at("name") == "t.Core.Shadow.Distance") Distance = Entry;
		if (Entry.at("name") == "t.Core.Name") Name = Entry;
	}
	EXPECT_EQ(Samples.at("type"), "int");
	EXPECT_EQ(Samples.at("default"), 1);
	EXPECT_EQ(Samples.at("value"), 5);
	EXPECT_EQ(Samples.at("set_by"), "ini");
	EXPECT_EQ(Samples.at("min"), 1);
	EXPECT_EQ(Samples.at("max"), 64);
	EXPECT_THAT(Samples.at("aliases").get<std::vector<std::string>>(), testing::Contains("x.Json.Samples"));
	EXPECT_EQ(Distance.at("default"), 0.1);
	EXPECT_FALSE(Name.contains("min"));
}

TEST_F(ConsoleVariables, MarkdownIsATableThatDependsOnDefinitionsOnly)
{
	const std::string Before = Registry.ToMarkdown();
	EXPECT_THAT(Before, HasSubstr("## t.Core.Shadow\n"));
	EXPECT_THAT(Before, HasSubstr("| `t.Core.Shadow.Samples` | int | `1` | 1 to 64 | "
	                              "Rays \\| per pixel.<br>Second line. | "));
	EXPECT_THAT(Before, HasSubstr("| `t.Core.Toggle` | bool | `1` |  | A toggle. | "));
	EXPECT_LT(Before.find("t.Core.Toggle"), Before.find("t.Core.Shadow.Samples")) << "General comes first";
	EXPECT_FALSE(Set("t.Core.Shadow.Samples", "33"));
	EXPECT_EQ(Registry.ToMarkdown(), Before);
}

} // namespace
} // namespace Lantern
