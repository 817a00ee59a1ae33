// The task trace: what it records, that its file is what viewers take, and that it stays small.
#include <thread>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "LanternCore/Config/ConsoleVariables.h"
#include "LanternCore/Tasks/TaskTrace.h"
#include "LanternCore/Tasks/Tasks.h"
#include "Support/CoreTestTools.h"

namespace Lantern
{
namespace
{

using nlohmann::json;
using ::testing::HasSubstr;
using ::testing::SizeIs;

class FTraceTest : public ::testing::Test
{
protected:
	void SetUp() override
	{
		FConsoleVariables::Get().ResetAll();
		FTaskTrace::Stop();
		FTaskTrace::Clear();
		FTaskTrace::SetFolder(Folder.GetPath());
	}
	void TearDown() override
	{
		FConsoleVariables::Get().ResetAll();
		NextFrame(0);
		FTaskTrace::Clear();
		FTaskTrace::SetFolder("");
	}
	static void Set(const char* Name, const std::string& Value)
	{
		EXPECT_FALSE(FConsoleVariables::Get().Set(Name, Value, ERTSetBy::Console, "test"));
	}
	static void NextFrame(uint64_t Frame)
	{
		FConsoleVariables::Get().BeginFrame();
		FTaskTrace::BeginFrame(Frame);
	}
	static std::vector<json> GetComplete(const json& Trace)
	{
		std::vector<json> Events;
		for (const json& Event : Trace.at("traceEvents"))
		{
			if (Event.at("ph") == "X") { Events.push_back(Event); }
		}
		return Events;
	}
	static json Find(const json& Trace, const std::string& Name)
	{
		for (const json& Event : GetComplete(Trace))
		{
			if (Event.at("name") == Name) { return Event; }
		}
		ADD_FAILURE() << "no event " << Name;
		return {};
	}
	std::string GetPath(const std::string& Name = "LanternTrace.json") const { return Folder.GetPath() + "/" + Name; }
	json Read(const std::string& Name = "LanternTrace.json") const { return json::parse(std::ifstream(GetPath(Name))); }
	FTemporaryFolder Folder;
};

TEST_F(FTraceTest, NothingIsRecordedWhileOff)
{
	{
		FTraceScope Scope("Unseen");
	}
	EXPECT_THAT(FTaskTrace::GetEvents(), SizeIs(0));
	FTaskTrace::Start();
	{
		FTraceScope Scope("Seen");
		FTaskTrace::Stop();
		FTraceScope Late("Unseen");
	}
	EXPECT_THAT(FTaskTrace::GetEvents(), SizeIs(1)) << "what began while it was on is whole";
}

TEST_F(FTraceTest, JsonHasNamesTimesFramesAndNesting)
{
	FTaskTrace::Start();
	FTaskTrace::NameThread("Main \"one\"");
	FTaskTrace::BeginFrame(7); // off by console variable: does nothing but stop
	FTaskTrace::Start();
	{
		FTraceScope Outer("Outer");
		FTraceScope Inner("Inner", "quote \" slash \\ line \n end");
		std::this_thread::sleep_for(std::chrono::milliseconds(2));
	}
	FTaskTrace::Record("\xff\xfe no UTF-8", 1, 2, 3);
	const json Trace = json::parse(FTaskTrace::ToJson());
	const json Outer = Find(Trace, "Outer"), Inner = Find(Trace, "Inner: quote \" slash \\ line \n end");
	EXPECT_EQ(Outer.at("tid"), Inner.at("tid"));
	EXPECT_LE(Outer.at("ts").get<double>(), Inner.at("ts").get<double>());
	EXPECT_GE(Outer.at("ts").get<double>() + Outer.at("dur").get<double>(), Inner.at("ts").get<double>() + Inner.at("dur").get<double>());
	EXPECT_GE(Inner.at("dur").get<double>(), 2000.0) << "microseconds";
	const std::vector<FTraceEvent> Events = FTaskTrace::GetEvents();
	const auto Slept = std::find_if(
	    Events.begin(), Events.end(), [](const FTraceEvent& Event) { return std::string_view(Event.Name).starts_with("Inner"); });
	ASSERT_NE(Slept, Events.end());
	const double Nanoseconds = static_cast<double>(Slept->EndNs - Slept->BeginNs);
	EXPECT_NEAR(Inner.at("dur").get<double>(), Nanoseconds / 1000.0, 1.0);
	EXPECT_EQ(Outer.at("args").at("frame"), 7);
	bool bNamed = false;
	for (const json& Event : Trace.at("traceEvents"))
	{
		bNamed |= Event.at("ph") == "M" && Event.at("name") == "thread_name" && Event.at("args").at("name") == "Main \"one\"" &&
		          Event.at("tid") == Outer.at("tid");
	}
	EXPECT_TRUE(bNamed);
}

TEST_F(FTraceTest, QueuesOfADeviceLieBesideTheThreads)
{
	FTaskTrace::Start();
	constexpr uint64_t First = 1'000'000'000; // by the device's clock, which has nothing to do with the CPU's
	FTaskTrace::AlignDevice(First, 5'000);
	FTaskTrace::RecordOnDevice("Queue", "Pass", First + 100, First + 300, 4);
	FTaskTrace::AlignDevice(First + 10'000, 17'000); // recorded later than the first frame allows: so all is later
	FTaskTrace::AlignDevice(First + 90'000, 80'000); // waited long for the device, and says nothing
	FTaskTrace::RecordOnDevice("Queue", "Next", First + 10'000, First + 10'500, 5);
	const json Trace = json::parse(FTaskTrace::ToJson());
	const json Pass = Find(Trace, "Pass"), Next = Find(Trace, "Next");
	EXPECT_NEAR(Pass.at("ts").get<double>(), 7.1, 1e-9) << "microseconds";
	EXPECT_NEAR(Pass.at("dur").get<double>(), 0.2, 1e-9);
	EXPECT_NEAR(Next.at("ts").get<double>(), 17.0, 1e-9);
	EXPECT_EQ(Pass.at("args").at("frame"), 4);
	EXPECT_EQ(Pass.at("tid"), Next.at("tid"));
	EXPECT_EQ(FTaskTrace::GetThreadNames().at(Pass.at("tid").get<size_t>()), "Queue");
}

TEST_F(FTraceTest, CallsAreRecordedWithTheirTime)
{
	FTaskTrace::RecordCall(nullptr, "Unseen", 1);
	EXPECT_FALSE(FTaskTrace::WantsCalls());
	Set("r.RT.Trace.Calls", "1");
	EXPECT_TRUE(FTaskTrace::WantsCalls());
	FTaskTrace::Start();
	FTaskTrace::RecordCall(nullptr, "vkCall", ~uint64_t(0)); // longer than the trace: begins with it
	const std::vector<FTraceEvent> Events = FTaskTrace::GetEvents();
	ASSERT_THAT(Events, SizeIs(1));
	EXPECT_EQ(std::string_view(Events[0].Name), "vkCall");
	EXPECT_EQ(Events[0].BeginNs, 0u);
}

TEST_F(FTraceTest, LongNamesAreCutBetweenCharacters)
{
	FTaskTrace::Start();
	std::string Long;
	while (Long.size() < 2 * FTraceEvent::MaxName) { Long += "\xc3\xa4"; }
	{
		FTraceScope Scope(Long);
		FTraceScope Detailed("x", Long);
	}
	ASSERT_THAT(FTaskTrace::GetEvents(), SizeIs(2));
	for (const FTraceEvent& Event : FTaskTrace::GetEvents())
	{
		EXPECT_EQ(std::string(Event.Name).find_last_of('\xc3'), std::string(Event.Name).size() - 2) << Event.Name;
	}
}

TEST_F(FTraceTest, ThreadsRecordAtOnceWhileOthersRead)
{
	FTaskTrace::Start();
	constexpr int Threads = 8, Each = 2000;
	std::atomic<bool> bDone{false};
	std::thread Reader([&] {
		while (!bDone) { EXPECT_TRUE(json::accept(FTaskTrace::ToJson())); }
	});
	std::vector<std::thread> Writers;
	for (int T = 0; T < Threads; ++T)
	{
		Writers.emplace_back([T] {
			FTaskTrace::NameThread("Writer " + std::to_string(T));
			for (int I = 0; I < Each; ++I) { FTraceScope Scope("Write", std::to_string(T)); }
		});
	}
	for (std::thread& Writer : Writers) { Writer.join(); }
	bDone = true;
	Reader.join();
	std::map<std::string, std::set<uint32_t>> ThreadsByName;
	std::map<std::string, int> Count;
	for (const FTraceEvent& Event : FTaskTrace::GetEvents())
	{
		ThreadsByName[Event.Name].insert(Event.Thread);
		++Count[Event.Name];
		EXPECT_LE(Event.BeginNs, Event.EndNs);
	}
	for (int T = 0; T < Threads; ++T)
	{
		const std::string Name = "Write: " + std::to_string(T);
		EXPECT_EQ(Count[Name], Each);
		ASSERT_THAT(ThreadsByName[Name], SizeIs(1));
		EXPECT_EQ(FTaskTrace::GetThreadNames()[*ThreadsByName[Name].begin()], "Writer " + std::to_string(T));
	}
}

TEST_F(FTraceTest, MemoryIsBoundedAndTheNewestStay)
{
	FTaskTrace::Start();
	constexpr size_t More = 1000;
	const size_t Count = FTaskTrace::MaxEventsPerThread + More;
	for (size_t I = 0; I < Count; ++I) { FTaskTrace::Record("Event", I, I + 1, FTraceEvent::NoFrame); }
	const std::vector<FTraceEvent> Events = FTaskTrace::GetEvents();
	ASSERT_THAT(Events, SizeIs(FTaskTrace::MaxEventsPerThread));
	EXPECT_EQ(FTaskTrace::GetForgottenCount(), More);
	uint64_t Oldest = ~0ull, Newest = 0;
	for (const FTraceEvent& Event : Events)
	{
		Oldest = std::min(Oldest, Event.BeginNs);
		Newest = std::max(Newest, Event.BeginNs);
	}
	EXPECT_EQ(Oldest, More);
	EXPECT_EQ(Newest, Count - 1);
	FTaskTrace::Clear();
	EXPECT_EQ(FTaskTrace::GetForgottenCount(), 0u);
	FTaskTrace::Record("Event", 1, 2, FTraceEvent::NoFrame);
	EXPECT_THAT(FTaskTrace::GetEvents(), SizeIs(1));
}

TEST_F(FTraceTest, AllThreadsTogetherAreBounded)
{
	FTaskTrace::Start();
	constexpr size_t Threads = 2 * FTaskTrace::MaxEvents / FTaskTrace::MaxEventsPerThread;
	for (size_t T = 0; T < Threads; ++T)
	{
		std::thread([] {
			for (size_t I = 0; I < FTaskTrace::MaxEventsPerThread; ++I) { FTaskTrace::Record("Event", I, I, 0); }
		}).join();
	}
	EXPECT_LE(FTaskTrace::GetEvents().size(), FTaskTrace::MaxEvents);
	EXPECT_EQ(FTaskTrace::GetEvents().size() + FTaskTrace::GetForgottenCount(), Threads * FTaskTrace::MaxEventsPerThread);
}

TEST_F(FTraceTest, FileIsWrittenWhenSwitchedOff)
{
	Set("r.RT.Trace", "1");
	NextFrame(4);
	EXPECT_TRUE(FTaskTrace::IsOn());
	{
		FTraceScope Scope("Work");
	}
	EXPECT_FALSE(std::filesystem::exists(GetPath()));
	Set("r.RT.Trace", "0");
	NextFrame(5);
	EXPECT_FALSE(FTaskTrace::IsOn());
	EXPECT_EQ(Find(Read(), "Work").at("args").at("frame"), 4);
	EXPECT_THAT(FTaskTrace::GetEvents(), SizeIs(0)) << "memory is given back";
	std::filesystem::remove(GetPath());
	NextFrame(6);
	FTaskTrace::Flush();
	EXPECT_FALSE(std::filesystem::exists(GetPath())) << "nothing new, nothing written";
}

TEST_F(FTraceTest, FileIsWrittenAtShutdownAndUnderItsName)
{
	Set("r.RT.Trace", "1");
	Set("r.RT.Trace.File", "Other.json");
	NextFrame(0);
	{
		FTraceScope Scope("Work");
	}
	FTaskTrace::Flush();
	Find(Read("Other.json"), "Work");
}

TEST_F(FTraceTest, FileOfEveryFewFramesHasTheseFramesAlone)
{
	Set("r.RT.Trace", "1");
	Set("r.RT.Trace.Frames", "3");
	for (uint64_t Frame = 0; Frame < 7; ++Frame)
	{
		NextFrame(Frame);
		if (Frame < 3) { EXPECT_FALSE(std::filesystem::exists(GetPath())); }
		FTraceScope Scope("Work");
	}
	std::vector<int> Frames;
	for (const json& Event : GetComplete(Read())) { Frames.push_back(Event.at("args").at("frame")); }
	EXPECT_THAT(Frames, ::testing::ElementsAre(3, 4, 5));
}

TEST_F(FTraceTest, FileThatCannotBeWrittenIsSaidOnceAndLeavesNothing)
{
	const FLogCapture Log;
	Set("r.RT.Trace", "1");
	Set("r.RT.Trace.File", "none/" + Folder.GetPath().substr(Folder.GetPath().size() - 6) + ".json");
	for (uint64_t Frame = 0; Frame < 3; ++Frame)
	{
		NextFrame(Frame);
		FTaskTrace::Flush();
	}
	EXPECT_EQ(Log.Count(ERTLogLevel::Warning), 1u);
	EXPECT_THAT(Log.GetTexts().back(), HasSubstr("r.RT.Trace"));
	EXPECT_TRUE(std::filesystem::is_empty(Folder.GetPath()));
	// A folder in its place: the temporary file beside it must go too.
	std::filesystem::create_directories(GetPath("Folder.json") + "/x");
	EXPECT_EQ(FTaskTrace::Write(GetPath("Folder.json")).Code, ERTResult::IoError);
	EXPECT_EQ(std::distance(std::filesystem::directory_iterator(Folder.GetPath()), {}), 1);
}

TEST_F(FTraceTest, TasksAreOnTheirThreads)
{
	FTaskTrace::Start();
	FTaskGroup Group;
	for (int I = 0; I < 100; ++I)
	{
		Group.Run([] {
			FTraceScope Scope("Task");
			std::this_thread::sleep_for(std::chrono::microseconds(100));
		});
	}
	Group.Wait();
	std::map<uint32_t, std::vector<FTraceEvent>> ByThread;
	for (const FTraceEvent& Event : FTaskTrace::GetEvents()) { ByThread[Event.Thread].push_back(Event); }
	size_t Count = 0;
	for (auto& [Thread, Events] : ByThread)
	{
		std::sort(Events.begin(), Events.end(), [](const auto& A, const auto& B) { return A.BeginNs < B.BeginNs; });
		for (size_t I = 1; I < Events.size(); ++I) { EXPECT_GE(Events[I].BeginNs, Events[I - 1].EndNs); }
		Count += Events.size();
	}
	EXPECT_EQ(Count, 100u);
}

} // namespace
} // namespace Lantern
