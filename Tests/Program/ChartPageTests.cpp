// The page of `lantern chart` in a real browser: drawn, pointed at, clicked, filtered, sorted.
#include <cstdlib>
#include <filesystem>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "Chart/ChartPage.h"
#include "Support/CoreTestTools.h"
#include "Support/WaitTools.h"

namespace Lantern
{
namespace
{

using nlohmann::json;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

// 3 × 2 pixels and 2 × 3: told apart by their sizes.
constexpr const char* Picture = "data:image/png;base64,iVBORw0KGgoAAAANSUhEUgAAAAMAAAACCAIAAAASFvFNAAAAEElEQVR4nGNo"
                                "cFCAIAY4CwA21AVBYVAZNAAAAABJRU5ErkJggg==";
constexpr const char* HeatMap = "data:image/png;base64,iVBORw0KGgoAAAANSUhEUgAAAAIAAAADCAIAAAA2iEnWAAAAEElEQVR4nGNo"
                                "cFAAIgYUCgA5dQVB6juf/wAAAABJRU5ErkJggg==";
/// Text that would end the element it stands in, or begin another, if the page let it.
constexpr const char* Hostile = "</script><script>window.onerror('injected')</script><b id=\"injected\">";

json MakePoint(const char* Method, const char* Preset, const json& GpuMs, const json& RelMse, const json& Flip)
{
	return {{"signal", "sun_shadow"}, {"method", Method}, {"preset", Preset}, {"path", "still"}, {"gpu_ms", GpuMs}, {"frame_gpu_ms", 20.5},
	    {"rays_per_pixel", 4}, {"memory", 3145728}, {"relmse", RelMse}, {"flip", Flip}, {"sigma", nullptr}, {"t90_frames", nullptr},
	    {"ghost", 0.0}, {"leak", nullptr}, {"frames", 24}, {"picture", std::string("picture ") + Preset},
	    {"heatmap", std::string("heat ") + Preset}};
}

json MakeData()
{
	const char* B = "B <!--<script>";
	json Points = {MakePoint("A", "p1", 1.0, 0.1, 0.3), MakePoint("A", "p2", 2.0, 0.02, 0.2), MakePoint("A", "p3", 8.0, 0.001, 0.2),
	    MakePoint("A", "p4", nullptr, 0.0005, 0.01), MakePoint(B, "q0", 0.0, 0.5, 0.6), MakePoint(B, "q1", 1.5, 0.05, 0.5),
	    MakePoint(B, "q2", 3.0, 0.03, 0.4), MakePoint(B, "q3", 4.0, 0.0, 0.1), MakePoint(B, "q4", 6.0, -0.001, 0.1)};
	Points.push_back(MakePoint("A", "p1", 1.0, 0.4, 0.4));
	Points.back()["path"] = "fast";
	json Second = MakePoint("A", "p9", 1.0, 0.4, 0.4);
	Second["path"] = "fast";
	json Occlusion = MakePoint("C", "r1", 5.0, 0.4, 0.4);
	Occlusion["signal"] = "ao";
	Occlusion["path"] = "slow";
	const json Skipped = {{"signal", "sun_shadow"}, {"method", "D"}, {"preset", "s"}, {"path", "still"}, {"reason", Hostile}};
	const json Other = {{"signal", "ao"}, {"method", "E"}, {"preset", "s"}, {"path", "still"}, {"reason", "no"}};
	const json Facts = {{{"fact", "alpha tests"}, {"frame_gpu_ms", 8.0}, {"without_gpu_ms", 6.0}},
	    {{"fact", "sky"}, {"frame_gpu_ms", 8.0}, {"without_gpu_ms", nullptr}}};
	return {{"version", 1}, {"device", "Test device"}, {"driver", "Driver 1.2"}, {"is_cpu", true},
	    {"settings", {{"size", Hostile}, {"frames", 24}, {"list", {1, 2}}}},
	    {"signals", {{{"name", "sun_shadow"}, {"title", "Sun shadow"}}, {{"name", "ao"}, {"title", "Occlusion"}}}},
	    {"scenes", {{{"name", "first"}, {"width", 3}, {"height", 2}, {"facts", Facts}, {"points", Points}, {"skipped", {Skipped, Other}}},
	                   {{"name", "second"}, {"facts", json::array()}, {"points", {Second, Occlusion}}, {"skipped", json::array()}}}},
	    {"images", {{"picture q1", Picture}, {"heat q1", HeatMap}, {"picture p1", "not a picture"}}}};
}

std::string ReadAll(const std::string& Path)
{
	std::ifstream Stream(Path, std::ios::binary);
	return {std::istreambuf_iterator<char>(Stream), {}};
}

/// Empty where there is none.
std::string FindBrowser()
{
	if (const char* Chosen = std::getenv("LANTERN_BROWSER")) { return Chosen; }
	const char* Path = std::getenv("PATH");
	std::istringstream Folders(Path != nullptr ? Path : "");
	for (std::string Folder; std::getline(Folders, Folder, ':');)
	{
		for (const char* Name : {"chromium", "chromium-browser", "google-chrome"})
		{
			if (std::filesystem::exists(std::filesystem::path(Folder) / Name)) { return (std::filesystem::path(Folder) / Name).string(); }
		}
	}
	return {};
}

/// Without the browser's own complaints about the desktop that it does not find.
std::string ReadLog(const std::string& Path)
{
	std::ifstream Stream(Path);
	std::string Text;
	for (std::string Line; std::getline(Stream, Line);) { Text += Line.find("dbus") == std::string::npos ? Line + "\n" : ""; }
	return Text;
}

void InsertBefore(std::string& Page, std::string_view Mark, const std::string& Text)
{
	const size_t At = Page.rfind(Mark);
	ASSERT_NE(At, std::string::npos) << Mark;
	Page.insert(At, Text);
}

class FChartPageTest : public testing::Test
{
protected:
	void SetUp() override
	{
		Browser = FindBrowser();
		// Continuous integration installs one (Scripts/Setup does): there a missing one is an error.
		const bool bDemanded = std::getenv("CI") != nullptr || std::getenv("LANTERN_DEMAND_BROWSER") != nullptr;
		if (Browser.empty() && bDemanded) { FAIL() << "no Chromium: Scripts/Setup installs the package chromium"; }
		else if (Browser.empty())
		{
			GTEST_SKIP() << "no Chromium, so the page was not looked at; Scripts/Setup installs the package chromium";
		}
	}

	/// Opens the page of Data with the driver appended, and returns what that saw. bLookOnly: uses nothing.
	json Drive(const json& Data, bool bLookOnly = false)
	{
		std::string Page = MakeChartPage(Data);
		// Before the page's own scripts, so that their errors are seen. Under virtual time a headless browser draws no
		// frames between the first and the last, so what waits for one (Chart.js, where the pointer moves) gets a timer.
		InsertBefore(Page, "<header>", R"(<script>
window.driverErrors = [];
window.onerror = (text) => window.driverErrors.push(String(text));
window.onunhandledrejection = (event) => window.driverErrors.push(String(event.reason));
window.requestAnimationFrame = (call) => setTimeout(() => call(performance.now()), 16);
</script>)");
		InsertBefore(Page, "</body>", "<script>" + ReadAll(LANTERN_SOURCE_DIR "/Tests/Program/ChartPageDriver.js") + "</script>");
		if (bLookOnly) { InsertBefore(Page, "lang=\"en\"", "data-drive=\"look\" "); }
		const std::string File = Folder.Write("page.html", Page), Base = Folder.GetPath();
		const std::string Command =
		    fmt::format("HOME={0} timeout {3} '{1}' --headless --no-sandbox --disable-gpu "
		                "--disable-dev-shm-usage "
		                "--enable-logging=stderr "
		                "--user-data-dir={0}/profile --window-size=1400,1800 --virtual-time-budget=20000 --dump-dom 'file://{2}' "
		                ">{0}/dom 2>{0}/log",
		        Base, Browser, File, WaitLimit.count());
		const int Status = std::system(Command.c_str());
		const std::string Dom = ReadAll(Base + "/dom"), Log = ReadLog(Base + "/log");
		EXPECT_EQ(Status, 0) << Log;
		EXPECT_THAT(Log, Not(HasSubstr("CONSOLE"))) << "the page wrote to the console";
		const std::string Begin = "<pre id=\"driver-result\">";
		const size_t At = Dom.rfind(Begin);
		if (At == std::string::npos)
		{
			ADD_FAILURE() << "the driver did not end; log:\n" << Log;
			return nullptr;
		}
		const json Seen = json::parse(Dom.substr(At + Begin.size(), Dom.find("</pre>", At) - At - Begin.size()), nullptr, false);
		EXPECT_THAT(Seen.at("errors"), IsEmpty());
		EXPECT_EQ(Dom.find("<b id=\"injected\""), std::string::npos) << "text of the data became part of the page";
		return Seen;
	}

	FTemporaryFolder Folder;
	std::string Browser;
};

TEST_F(FChartPageTest, CanBeUsed)
{
	json Seen = Drive(MakeData());
	ASSERT_TRUE(Seen.contains("ao")) << Seen.dump(1);
	const std::string B = "B <!--<script>";

	EXPECT_EQ(Seen["device"], "Test device");
	EXPECT_EQ(Seen["driver"], "Driver 1.2");
	EXPECT_EQ(Seen["notice"], true);

	// p3 is no better than q3, q2 no better than p2, p4 has no time; 0 is the best of times and of errors, and q4 below
	// it is not better.
	EXPECT_EQ(Seen["start"]["rows"].size(), 9u);
	EXPECT_THAT(Seen["start"]["front"], ElementsAre("A/p1", "A/p2", B + "/q0", B + "/q1", B + "/q3"));
	EXPECT_GT(Seen["start"]["ink"], 1000);
	EXPECT_EQ(Seen["notDrawn"], "1 not drawn: no GPU time or no relMSE.");

	EXPECT_EQ(Seen["hover"]["opacity"], 1);
	EXPECT_THAT(Seen["hover"]["title"], ElementsAre("A · p2"));
	EXPECT_EQ(Seen["hover"]["lines"].size(), 11u);
	EXPECT_THAT(Seen["hover"]["lines"].dump(), HasSubstr("relMSE: 0.02"));
	EXPECT_THAT(Seen["hover"]["lines"].dump(), HasSubstr("memory: 3 MiB"));

	EXPECT_TRUE(Seen["beforeClick"].is_null());
	const json& Clicked = Seen["afterClick"];
	EXPECT_EQ(Clicked["title"], B + " · q1");
	ASSERT_TRUE(Clicked["picture"].is_object() && Clicked["heatmap"].is_object()) << Clicked;
	EXPECT_EQ(Clicked["picture"]["width"], 3);
	EXPECT_EQ(Clicked["heatmap"]["width"], 2);
	EXPECT_EQ(Clicked["picture"]["top"], Clicked["heatmap"]["top"]) << "not side by side";
	EXPECT_GE(
	    Clicked["heatmap"]["left"].get<double>(), Clicked["picture"]["left"].get<double>() + Clicked["picture"]["shown"].get<double>());
	EXPECT_TRUE(Seen["withoutPictures"]["picture"].is_null()) << "what is no picture is not shown as one";
	EXPECT_EQ(Seen["afterArrow"]["title"], B + " · q1") << "the next point to the right of A's p1";
}

TEST_F(FChartPageTest, FiltersAndSorts)
{
	json Seen = Drive(MakeData());
	ASSERT_TRUE(Seen.contains("ao")) << Seen.dump(1);

	EXPECT_THAT(Seen["ascending"], ElementsAre("q4", "q3", "p4", "p3", "p2", "q2", "q1", "p1", "q0"));
	EXPECT_THAT(Seen["descending"], ElementsAre("q0", "p1", "q1", "q2", "p2", "p3", "p4", "q3", "q4"));

	EXPECT_THAT(Seen["onlyA"]["front"], ElementsAre("A/p1", "A/p2", "A/p3")) << "sorted by relMSE, downwards";
	EXPECT_EQ(Seen["onlyA"]["rows"].size(), 4u);
	EXPECT_LT(Seen["onlyA"]["ink"], Seen["start"]["ink"]);
	EXPECT_GT(Seen["onlyA"]["ink"], 300);
	EXPECT_THAT(Seen["flip"]["front"], ElementsAre("A/p1", "A/p2")) << "p3 is slower than p2 and has the same FLIP";
	EXPECT_THAT(Seen["none"]["rows"], IsEmpty());
	EXPECT_EQ(Seen["none"]["ink"], 0);
	EXPECT_EQ(Seen["noneText"], true);
	EXPECT_THAT(Seen["fast"]["rows"], ElementsAre("A/p1"));
	EXPECT_TRUE(Seen["selectionKept"].is_null()) << "a point out of view stayed chosen";
	EXPECT_THAT(Seen["second"]["rows"], ElementsAre("A/p9"));
	EXPECT_THAT(Seen["ao"]["rows"], ElementsAre("C/r1")) << "its only camera path is chosen by itself";
	EXPECT_GT(Seen["ao"]["ink"], 50);

	ASSERT_EQ(Seen["facts"].size(), 2u);
	EXPECT_THAT(Seen["facts"][0], ElementsAre("alpha tests", "8", "6", "2", "25 %", ""));
	EXPECT_THAT(Seen["facts"][1], ElementsAre("sky", "8", "–", "–", "–", ""));
	ASSERT_EQ(Seen["skipped"].size(), 1u) << "only of the signal that is shown";
	EXPECT_THAT(Seen["skipped"][0], ElementsAre("D", "s", "still", Hostile));
}

TEST_F(FChartPageTest, SurvivesDataWithoutFigures)
{
	json Empty = Drive(json::object(), true);
	EXPECT_THAT(Empty["start"]["rows"], IsEmpty());
	EXPECT_EQ(Empty["notice"], false);

	json Zeros = MakeData();
	for (json& Point : Zeros["scenes"][0]["points"]) { Point["gpu_ms"] = Point["relmse"] = 0.0; }
	EXPECT_GT(Drive(Zeros, true)["start"]["ink"], 50) << "all at the feet of both axes";

	for (json& Point : Zeros["scenes"][0]["points"])
	{
		Point["gpu_ms"] = nullptr;
		Point.erase("relmse");
	}
	EXPECT_EQ(Drive(Zeros, true)["start"]["ink"], 0);
}

TEST(ChartPage, LoadsNothingAndEscapesData)
{
	json Data = MakeData();
	Data["device"] = "\xff\xfe broken";
	const std::string Page = MakeChartPage(Data);
	EXPECT_EQ(Page.find("</script><script>window.onerror"), std::string::npos);
	for (const char* Loading : {"src=\"http", "href=\"http", "@import", "fetch(", "XMLHttpRequest", "{{"})
	{
		EXPECT_EQ(Page.find(Loading), std::string::npos) << Loading;
	}
	EXPECT_THAT(Page, HasSubstr("default-src 'none'"));
	EXPECT_THAT(Page, HasSubstr("Released under the MIT License"));
	EXPECT_THAT(Page, HasSubstr("Permission is hereby granted"));
}

} // namespace
} // namespace Lantern
