// The registry of methods, and the scope that sets one.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "LanternMeasure/MeasureSequence.h"
#include "LanternMeasure/Methods.h"
#include "Support/TextCheck.h"

namespace Lantern
{
namespace
{

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

TRTConsoleVariable<int32_t> CVarRays("t.Methods.Rays", 1, "Of the test.", {1, 64});
TRTConsoleVariable<bool> CVarSoft("t.Methods.Soft", true, "Of the test.");

/// Links the renderer, whose console variables shipped methods set.
[[maybe_unused]] const volatile auto Linked = &PlayScript;

class Methods : public testing::Test
{
protected:
	void SetUp() override { FConsoleVariables::Get().ResetAll(); }
	void TearDown() override { FConsoleVariables::Get().ResetAll(); }
};

constexpr const char* Good = "[MethodDefaults]\n"
                             "+CVars=t.Methods.Soft=0\n"
                             "[Method.A]\n"
                             "Title=a method\n"
                             "Signal=sun_shadow\n"
                             "Needs=query\n"
                             "+CVars=t.Methods.Soft=1\n"
                             "+Presets=cheap: t.Methods.Rays=2\n"
                             "+Presets=dear, and how: t.Methods.Rays=8  t.Methods.Soft=0\n"
                             "Typical=dear, and how\n"
                             "[Method.B]\n"
                             "Signal=frame\n"
                             "+Presets=only:\n";

TEST_F(Methods, AreReadInOrder)
{
	const FMethods Read = ParseMethods(Good, "m.ini");
	EXPECT_THAT(Read.Problems, IsEmpty());
	ASSERT_EQ(Read.Methods.size(), 2u);
	const FMethod& A = Read.Methods[0];
	EXPECT_EQ(A.Name, "A");
	EXPECT_EQ(A.Title, "a method");
	EXPECT_EQ(A.Signal, ESignal::SunShadow);
	EXPECT_EQ(A.Needs, EMethodNeeds::Query);
	ASSERT_EQ(A.Presets.size(), 2u);
	EXPECT_EQ(A.Presets[0].Name, "cheap");
	EXPECT_EQ(A.GetTypical().Name, "dear, and how");
	ASSERT_EQ(A.GetTypical().Settings.size(), 2u);
	EXPECT_EQ(A.GetTypical().Settings[0].Name, "t.Methods.Rays");
	EXPECT_EQ(A.GetTypical().Settings[0].Value, "8");
	EXPECT_EQ(A.GetTypical().Settings[0].Where, "m.ini:9");
	EXPECT_EQ(Read.Methods[1].Title, "B");
	EXPECT_EQ(Read.Find("A METHOD"), &A);
	EXPECT_EQ(Read.Find("a"), &A);
	EXPECT_EQ(Read.Find("c"), nullptr);
}

TEST_F(Methods, NameTheLineThatIsWrong)
{
	const auto Problem = [](const char* Text) {
		const FMethods Read = ParseMethods(Text, "m.ini");
		EXPECT_THAT(Read.Methods, IsEmpty());
		return Read.Problems.size() == 1 ? Read.Problems[0] : "not one problem";
	};
	EXPECT_EQ(Problem("[Method.A]\nSignal=moon\n+Presets=p:\n"), "m.ini:2: 'moon' is no signal");
	EXPECT_EQ(Problem("[Method.A]\n+Presets=p:\n"), "m.ini:1: no Signal");
	EXPECT_EQ(Problem("[Method.A]\nSignal=frame\n"), "m.ini:1: no Presets");
	EXPECT_EQ(Problem("[Method.A]\nSignal=frame\n+Presets=p: t.Methods.Ray=1\n"), "m.ini:3: 't.Methods.Ray' is no console variable");
	EXPECT_EQ(Problem("[Method.A]\nSignal=frame\n+Presets=p: t.Methods.Rays\n"), "m.ini:3: 't.Methods.Rays' is not of the form NAME=VALUE");
	EXPECT_EQ(Problem("[Method.A]\nSignal=frame\n+Presets=p\n"), "m.ini:3: 'p' is not of the form PRESET: NAME=VALUE …");
	EXPECT_EQ(Problem("[Method.A]\nSignal=frame\n+Presets=p:\n+Presets=P: t.Methods.Rays=2\n"), "m.ini:4: a second preset 'P'");
	EXPECT_EQ(Problem("[Method.A]\nSignal=frame\nNeeds=luck\n+Presets=p:\n"), "m.ini:3: Needs is 'luck', expected pipeline, query or any");
	EXPECT_EQ(Problem("[Method.A]\nSignal=frame\n+Presets=p:\nTypical=q\n"), "m.ini:4: Typical is 'q', which is none of the presets");
	EXPECT_THAT(Problem("[Method.A]\nSignals=frame\n"), HasSubstr("m.ini:2: 'Signals' is none of"));
	EXPECT_THAT(Problem("[Methods]\n"), HasSubstr("m.ini:1: section 'Methods'"));
	EXPECT_THAT(LoadMethods("/nowhere/m.ini").Problems, ElementsAre(HasSubstr("/nowhere/m.ini")));
}

TEST_F(Methods, TextThatIsBrokenIsShownAsEscapes)
{
	const std::string Broken = "\xff\u0085\u202E";
	for (const std::string& Text :
	    {"[" + Broken + "]\n", "[MethodDefaults]\n" + Broken + "=1\n", "[MethodDefaults]\nCVars=" + Broken + "\n",
	        "[MethodDefaults]\nCVars=" + Broken + "=1\n", "[Method.A]\nSignal=" + Broken + "\n", "[Method.A]\n" + Broken + "=1\n",
	        "[Method.A]\nNeeds=" + Broken + "\n", "[Method.A]\nPresets=" + Broken + "\n",
	        "[Method.A]\nSignal=frame\n+Presets=" + Broken + ":\n+Presets=" + Broken + ": t.Methods.Rays=2\n",
	        "[Method.A]\nSignal=frame\n+Presets=p:\nTypical=" + Broken + "\n"})
	{
		const FMethods Read = ParseMethods(Text, "m.ini");
		ASSERT_EQ(Read.Problems.size(), 1u) << testing::PrintToString(Text);
		EXPECT_TRUE(IsCleanText(Read.Problems[0])) << testing::PrintToString(Read.Problems[0]);
		EXPECT_THAT(Read.Problems[0], HasSubstr("\\xff\\u{0085}\\u{202e}"));
	}
	// Names go into tables and JSON.
	const FMethods Read = ParseMethods("[Method.A" + Broken + "]\nTitle=" + Broken + "\nSignal=frame\n+Presets=" + Broken + ":\n", "m.ini");
	ASSERT_EQ(Read.Methods.size(), 1u);
	for (const std::string& Name : {Read.Methods[0].Name, Read.Methods[0].Title, Read.Methods[0].Presets[0].Name})
	{
		EXPECT_TRUE(IsCleanText(Name)) << testing::PrintToString(Name);
	}
}

TEST_F(Methods, OneThatIsWrongLeavesTheOthers)
{
	const FMethods Read = ParseMethods(
	    std::string(Good) + "[Method.C]\nSignal=frame\nTitle=B\n+Presets=p:\n[Method.D]\nSignal=frame\n+Presets=p:\n", "m.ini");
	EXPECT_THAT(Read.Problems, ElementsAre("m.ini:14: a second method 'B'"));
	EXPECT_EQ(Read.Methods.size(), 3u);
	EXPECT_NE(Read.Find("D"), nullptr);
}

TEST_F(Methods, NeedWhatTheDeviceHas)
{
	FMethod Method;
	FRTCapabilities Device;
	EXPECT_EQ(GetMissing(Method, Device), "");
	Method.Needs = EMethodNeeds::Query;
	EXPECT_EQ(GetMissing(Method, Device), "the device has no ray queries");
	Device.bRayQuery = true;
	EXPECT_EQ(GetMissing(Method, Device), "");
	Method.Needs = EMethodNeeds::Pipeline;
	EXPECT_EQ(GetMissing(Method, Device), "the device has no ray-tracing pipelines");
}

TEST_F(Methods, ScopePutsBackValueAndWhoSetIt)
{
	const FMethods Read = ParseMethods(Good, "m.ini");
	FConsoleVariables& Variables = FConsoleVariables::Get();
	Variables.Set("t.Methods.Rays", "3", ERTSetBy::CommandLine, "");
	{
		FMethodScope Scope;
		EXPECT_THAT(Scope.Apply(Read, &Read.Methods[0], &Read.Methods[0].Presets[0]), IsEmpty());
		EXPECT_EQ(CVarRays.Get(), 2);
		EXPECT_TRUE(CVarSoft.Get());                // the method's after the defaults
		EXPECT_NE(CVarRays.GetOnRenderThread(), 2); // not before the frame
		Variables.BeginFrame();
		EXPECT_EQ(CVarRays.GetOnRenderThread(), 2);
		FMethodScope Inner;
		EXPECT_THAT(Inner.Apply(Read, &Read.Methods[0], &Read.Methods[0].Presets[1]), IsEmpty());
		EXPECT_EQ(CVarRays.Get(), 8);
		EXPECT_FALSE(CVarSoft.Get());
		Inner.Restore();
		EXPECT_EQ(CVarRays.Get(), 2);
	}
	EXPECT_EQ(CVarRays.Get(), 3);
	EXPECT_EQ(CVarRays.GetSetBy(), ERTSetBy::CommandLine);
	EXPECT_TRUE(CVarSoft.Get());
	EXPECT_EQ(CVarSoft.GetSetBy(), ERTSetBy::Code);
	Variables.BeginFrame();
	EXPECT_EQ(CVarRays.GetOnRenderThread(), 3);
	Variables.Set("t.Methods.Rays", "4", ERTSetBy::CommandLine, "");
	EXPECT_EQ(CVarRays.Get(), 4); // not locked by the scope's higher right
}

TEST_F(Methods, ScopeWithAWrongValueSetsNothing)
{
	FMethodScope Scope;
	EXPECT_THAT(
	    Scope.Apply({{"t.Methods.Soft", "0", "m.ini:1"}, {"t.Methods.Rays", "many", "m.ini:2"}}), ElementsAre(HasSubstr("m.ini:2")));
	EXPECT_TRUE(CVarSoft.Get());
	EXPECT_EQ(CVarRays.Get(), 1);
	EXPECT_EQ(CVarSoft.GetSetBy(), ERTSetBy::Code);
}

/// What is shipped: no problem, every value taken as it is written.
TEST_F(Methods, ShippedOnesAreRight)
{
	const FMethods Shipped = LoadMethods(LANTERN_SOURCE_DIR "/Config/Methods.ini");
	EXPECT_THAT(Shipped.Problems, IsEmpty());
	EXPECT_GE(Shipped.Methods.size(), 15u);
	for (const FMethod& Method : Shipped.Methods)
	{
		for (const FMethodPreset& Preset : Method.Presets)
		{
			FMethodScope Scope;
			EXPECT_THAT(Scope.Apply(Shipped, &Method, &Preset), IsEmpty());
			for (const FMethodSetting& Setting : Preset.Settings)
			{
				EXPECT_EQ(FConsoleVariables::ToString(FConsoleVariables::Get().Find(Setting.Name)->GetValue()), Setting.Value)
				    << Setting.Where;
			}
		}
	}
}

} // namespace
} // namespace Lantern
