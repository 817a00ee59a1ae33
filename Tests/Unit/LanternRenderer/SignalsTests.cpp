// The registry of signals: whoever adds a signal is held to it.
#include <set>

#include "LanternSignals/Signals.h"
#include "Support/RendererTestTools.h"

namespace Lantern
{
namespace
{

TEST(Signals, NamesAreUniqueAndFound)
{
	std::set<std::string> Names, Titles, Passes;
	for (const FSignalInfo& Info : SignalInfos)
	{
		EXPECT_TRUE(Names.insert(Info.Name).second) << Info.Name;
		EXPECT_TRUE(Titles.insert(Info.Title).second) << Info.Title;
		EXPECT_TRUE(Passes.insert(Info.Pass).second) << Info.Pass;
		EXPECT_EQ(FindSignal(Info.Name), Info.Signal);
		EXPECT_NE(ListSignalNames().find(Info.Name), std::string::npos);
	}
	EXPECT_EQ(FindSignal("no_such_signal"), std::nullopt);
	EXPECT_EQ(FindSignal(""), std::nullopt);
}

TEST(Signals, FormatsHoldTheirChannels)
{
	for (const FSignalInfo& Info : SignalInfos)
	{
		const bool bOne = Info.Format == ERTFormat::R16_FLOAT;
		EXPECT_TRUE(bOne || Info.Format == ERTFormat::RGBA16_FLOAT || Info.Format == ERTFormat::RGBA32_FLOAT) << Info.Name;
		EXPECT_EQ(Info.Channels, bOne ? 1u : 3u) << Info.Name;
		EXPECT_EQ(std::string(Info.Pass).empty(), Info.Signal == ESignal::Frame) << Info.Name;
	}
}

TEST(Signals, ReferenceVariablesExist)
{
	for (const FSignalInfo& Info : SignalInfos)
	{
		std::istringstream Names(Info.ReferenceVariables);
		for (std::string Name; Names >> Name;) { EXPECT_TRUE(FConsoleVariables::Get().Find(Name)) << Info.Name << ": " << Name; }
	}
}

TEST(Signals, SetsHoldWhatWasAdded)
{
	FSignalSet Set;
	for (const FSignalInfo& Info : SignalInfos)
	{
		EXPECT_FALSE(Set.Has(Info.Signal)) << Info.Name;
		Set.Add(Info.Signal);
		EXPECT_TRUE(Set.Has(Info.Signal)) << Info.Name;
	}
	Set.Remove(ESignal::SunShadow);
	EXPECT_FALSE(Set.Has(ESignal::SunShadow));
	EXPECT_TRUE(Set.Has(ESignal::Frame));
	FSignalSet Joined = {ESignal::SunShadow};
	Joined |= Set;
	Set.Add(ESignal::SunShadow);
	EXPECT_EQ(Joined, Set);
}

class FDebugViewTest : public FRendererTest
{};

TEST_F(FDebugViewTest, ShowsASignalInsteadOfThePicture)
{
	LoadAndRender({.bSky = true});
	EXPECT_FALSE(HasPass("DebugView")) << "the picture is the default";
	Set("r.RT.Debug.View", "sun_shadow");
	Render();
	EXPECT_TRUE(HasPass("DebugView"));
	Set("r.RT.Debug.View", "no_such_signal");
	Render();
	EXPECT_FALSE(HasPass("DebugView")) << "an unknown name shows the picture";
}

// The filter draws them itself, and nothing without them.
TEST_F(FDebugViewTest, ShowsTheHistoryOfAFilter)
{
	LoadAndRender({.bSky = true});
	for (const char* const Name : {"SunShadow.confidence", "SunShadow.change", "AmbientOcclusion.confidence"})
	{
		Set("r.RT.Debug.View", Name);
		Render();
		EXPECT_FALSE(HasPass("DebugView")) << Name;
		EXPECT_FALSE(HasPass("ToneMap")) << Name << ": the picture is shown";
	}
	Set("r.RT.Shadow.Denoise", "0");
	Set("r.RT.Debug.View", "SunShadow.confidence");
	Render();
	EXPECT_FALSE(HasPass("SunShadowTemporal"));
	EXPECT_TRUE(HasPass("ToneMap")) << "there is no history";
}

TEST_F(FDebugViewTest, MakesWhatTheCompositeHasNoUseFor)
{
	LoadAndRender(FContent{});
	EXPECT_FALSE(HasPass("AmbientOcclusion")) << "there is no sky";
	Set("r.RT.Debug.View", "ambient_occlusion");
	Render();
	EXPECT_TRUE(HasPass("AmbientOcclusion"));
}

TEST_F(FDebugViewTest, ShowsThePictureIfTheSignalIsOff)
{
	LoadAndRender({.bSky = true});
	Set("r.RT.Shadow", "0");
	Set("r.RT.Debug.View", "sun_shadow");
	Render();
	EXPECT_FALSE(HasPass("DebugView"));
	EXPECT_TRUE(HasPass("ToneMap"));
}

} // namespace
} // namespace Lantern
