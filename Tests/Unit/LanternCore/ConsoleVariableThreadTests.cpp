// Meant for the thread sanitizer as much as for their own expectations.
#include <atomic>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

#include "LanternCore/Config/ConsoleVariables.h"
#include "Support/CoreTestTools.h"

namespace Lantern
{
namespace
{

TRTConsoleVariable<int32_t> CVarCount("t.Threads.Count", 0, "", {0, 1'000'000});
TRTConsoleVariable<std::string> CVarText("t.Threads.Text", std::string(64, 'a'), "");
TRTConsoleVariable<bool> CVarFlag("t.Threads.Flag", false, "");

constexpr int Writers = 4;
constexpr int WritesEach = 400;

bool IsOneLetter(const std::string& Text) { return Text.size() == 64 && Text.find_first_not_of(Text[0]) == std::string::npos; }

void Write(int Writer)
{
	FConsoleVariables& Registry = FConsoleVariables::Get();
	for (int I = 1; I <= WritesEach; ++I)
	{
		const std::string Text(64, static_cast<char>('a' + (Writer + I) % 26));
		EXPECT_FALSE(Registry.Set("t.Threads.Text", Text, ERTSetBy::Console, ""));
		EXPECT_FALSE(Registry.Set("t.Threads.Count", std::to_string(I), ERTSetBy::Console, ""));
		EXPECT_FALSE(Registry.Set("t.Threads.Flag", I % 2 ? "1" : "0", ERTSetBy::Console, ""));
		EXPECT_TRUE(Registry.Set("t.Threads.Cuont", "1", ERTSetBy::Console, ""));
		EXPECT_TRUE(IsOneLetter(CVarText.Get()));
	}
}

void Read(const std::atomic<bool>& bStop)
{
	FConsoleVariables& Registry = FConsoleVariables::Get();
	while (!bStop)
	{
		EXPECT_TRUE(IsOneLetter(CVarText.Get()));
		EXPECT_GE(CVarCount.Get(), 0);
		EXPECT_LE(CVarCount.GetSetBy(), ERTSetBy::Console);
		EXPECT_NE(Registry.Find("T.THREADS.FLAG"), nullptr);
		Registry.AddAlias("t.Threads.Alias", "t.Threads.Count");
		EXPECT_FALSE(Registry.ToJson().empty());
		EXPECT_FALSE(Registry.ToMarkdown().empty());
	}
}

TEST(ConsoleVariableThreads, AFrameSeesOneValueFromStartToEnd)
{
	FLogCapture Log;
	FConsoleVariables& Registry = FConsoleVariables::Get();
	int CallbackRuns = 0;
	CVarText.SetCallback([&](const FRTConsoleVariable&) { ++CallbackRuns; });

	std::atomic<bool> bStop{false};
	std::thread Reader([&] { Read(bStop); });
	std::vector<std::thread> Threads;
	std::atomic<int> Running{Writers};
	for (int Writer = 0; Writer < Writers; ++Writer)
		Threads.emplace_back([&, Writer] {
			Write(Writer);
			--Running;
		});

	int Frames = 0;
	do {
		Registry.BeginFrame();
		const int32_t Count = CVarCount.GetOnRenderThread();
		const std::string Text = CVarText.GetOnRenderThread();
		const bool bFlag = CVarFlag.GetOnRenderThread();
		std::this_thread::yield();
		EXPECT_TRUE(IsOneLetter(Text));
		EXPECT_EQ(CVarCount.GetOnRenderThread(), Count);
		EXPECT_EQ(CVarText.GetOnRenderThread(), Text);
		EXPECT_EQ(CVarFlag.GetOnRenderThread(), bFlag);
		++Frames;
	}
	while (Running > 0);

	for (std::thread& Thread : Threads) Thread.join();
	bStop = true;
	Reader.join();
	Registry.BeginFrame();
	EXPECT_EQ(CVarCount.GetOnRenderThread(), WritesEach);
	EXPECT_GT(CallbackRuns, 0);
	EXPECT_LE(CallbackRuns, Frames + 1);
	EXPECT_EQ(Log.Count(ERTLogLevel::Warning), size_t(Writers) * WritesEach);
	CVarText.SetCallback({});
	Registry.ResetAll();
	Registry.BeginFrame();
}

TEST(ConsoleVariableThreads, VariablesMayComeAndGoBesideFrames)
{
	std::atomic<bool> bDone{false};
	std::thread Maker([&] {
		for (int I = 0; I < 300; ++I)
		{
			TRTConsoleVariable<int32_t> Variable("t.Threads.Passing", 1, "");
			EXPECT_FALSE(FConsoleVariables::Get().Set("t.Threads.Passing", "2", ERTSetBy::Console, ""));
			EXPECT_EQ(Variable.Get(), 2);
		}
		bDone = true;
	});
	while (!bDone) FConsoleVariables::Get().BeginFrame();
	Maker.join();
	EXPECT_EQ(FConsoleVariables::Get().Find("t.Threads.Passing"), nullptr);
}

} // namespace
} // namespace Lantern
