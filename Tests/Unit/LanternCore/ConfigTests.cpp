#include <map>
#include <set>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "LanternCore/Config/Config.h"
#include "LanternCore/Config/IniFile.h"
#include "Support/CoreTestTools.h"

namespace Lantern
{
namespace
{

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

TRTConsoleVariable<int32_t> CVarA("t.Config.A", 0, "", {0, 100});
TRTConsoleVariable<int32_t> CVarB("t.Config.B", 0, "");
TRTConsoleVariable<std::string> CVarText("t.Config.Text", "", "");

class Config : public testing::Test
{
protected:
	Config() { FConsoleVariables::Get().ResetAll(); }
	~Config() override { FConsoleVariables::Get().ResetAll(); }

	/// What is returned has been logged, once each.
	FConfigProblems Checked(FConfigProblems Problems)
	{
		EXPECT_EQ(Log.GetTexts(), Problems);
		return Problems;
	}

	FTemporaryFolder Files;
	FConfigFolder Folder{Files.GetPath()};
	FLogCapture Log;
};

TEST_F(Config, DefaultsSetVariablesAsIni)
{
	Files.Write("ConsoleVariableAliases.ini", "[ConsoleVariableAliases]\nx.Config.Engine=t.Config.B\n");
	Files.Write("DefaultLantern.ini", "[SystemSettings]\nt.Config.A=5\nx.Config.Engine=7\n"
	                                  "[ConsoleVariables]\nt.Config.Text=\"a b\"\n[/Script/Engine.Thing]\nq=1\n");
	EXPECT_THAT(Checked(LoadDefaults(Folder)), IsEmpty());
	EXPECT_EQ(CVarA.Get(), 5);
	EXPECT_EQ(CVarA.GetSetBy(), ERTSetBy::Ini);
	EXPECT_EQ(CVarB.Get(), 7);
	EXPECT_EQ(CVarText.Get(), "a b");
}

TEST_F(Config, EveryMistakeIsNamedWithItsPlaceAndTheRestApplies)
{
	const std::string Path = Files.Write("Game.ini", "[SystemSettings]\nt.Config.AA=1\nnonsense\nt.Config.B=x\n"
	                                                 "t.Config.A=3\n[SystemSetings]\nt.Config.A=4\n");
	const FConfigProblems Problems = LoadFile(Folder, Path);
	EXPECT_THAT(Problems, ElementsAre(HasSubstr("Game.ini:3: 'nonsense'"),
	                          HasSubstr("Game.ini:2: unknown console variable 't.Config.AA'; the nearest name "
	                                    "is 't.Config.A'"),
	                          HasSubstr("Game.ini:4: t.Config.B: 'x' is not a whole number"),
	                          HasSubstr("Game.ini:6: unknown section [SystemSetings]; the nearest is "
	                                    "[SystemSettings]")));
	EXPECT_EQ(CVarA.Get(), 3);
	Checked(Problems);
}

TEST_F(Config, MissingFilesAreProblemsNotCrashes)
{
	EXPECT_EQ(Checked(LoadDefaults({"/nowhere/at/all"})).size(), 2u);
	EXPECT_EQ(LoadScalability({"/nowhere"}, ERTQuality::High).size(), 1u);
	EXPECT_EQ(LoadDeviceProfile({"/nowhere"}, "x").Problems.size(), 1u);
	EXPECT_THAT(LoadFile(Folder, Files.GetPath()), ElementsAre(HasSubstr("is a folder")));
	EXPECT_THAT(ListConsoleVariables({"/nowhere"}), IsEmpty());
}

TEST_F(Config, ScalabilitySetsItsLevelOfEveryGroup)
{
	Files.Write("Scalability.ini", "[ShadowQuality@0]\nt.Config.A=1\n[ShadowQuality@3]\nt.Config.A=4\n"
	                               "[OtherQuality@3]\nt.Config.B=9\n[OtherQuality@epic]\nt.Config.Text=e\n");
	EXPECT_THAT(Checked(LoadScalability(Folder, ERTQuality::Epic)), IsEmpty());
	EXPECT_EQ(CVarA.Get(), 4);
	EXPECT_EQ(CVarA.GetSetBy(), ERTSetBy::Scalability);
	EXPECT_EQ(CVarB.Get(), 9);
	EXPECT_EQ(CVarText.Get(), "e");
	EXPECT_THAT(LoadScalability(Folder, ERTQuality::Low), IsEmpty());
	EXPECT_EQ(CVarA.Get(), 1);
	EXPECT_EQ(CVarB.Get(), 9);
	EXPECT_THAT(LoadScalabilityGroup(Folder, "shadowquality", ERTQuality::Epic), IsEmpty());
	EXPECT_EQ(CVarA.Get(), 4);
}

TEST_F(Config, ScalabilitySectionsThatAreNoneAreNamed)
{
	Files.Write("Scalability.ini", "[ShadowQuality]\nt.Config.A=1\n[ShadowQuality@9]\nt.Config.A=1\n[@1]\n");
	EXPECT_THAT(LoadScalability(Folder, ERTQuality::Low),
	    ElementsAre(HasSubstr(":1: [ShadowQuality] is not"), HasSubstr(":3: [ShadowQuality@9]"), HasSubstr(":5: [@1]")));
	EXPECT_EQ(CVarA.GetSetBy(), ERTSetBy::Code);
}

TEST_F(Config, AFileMayChooseAQualityPerGroup)
{
	Files.Write("Scalability.ini", "[ShadowQuality@3]\nt.Config.A=4\n[OtherQuality@3]\nt.Config.B=9\n");
	const std::string Path = Files.Write("Game.ini", "[ScalabilityGroups]\nsg.ShadowQuality=3\n"
	                                                 "sg.ShadwQuality=3\nsg.OtherQuality=best\n");
	EXPECT_THAT(Checked(LoadFile(Folder, Path)),
	    ElementsAre(HasSubstr(":3: unknown scalability group 'sg.ShadwQuality'; the nearest is 'ShadowQuality'"),
	        HasSubstr(":4: sg.OtherQuality: 'best' is not a quality")));
	EXPECT_EQ(CVarA.Get(), 4);
	EXPECT_EQ(CVarA.GetSetBy(), ERTSetBy::Scalability);
	EXPECT_EQ(CVarB.Get(), 0);
}

TEST(Quality, NamesAndNumbers)
{
	EXPECT_EQ(ParseQuality("low"), ERTQuality::Low);
	EXPECT_EQ(ParseQuality("Cinematic"), ERTQuality::Cinematic);
	EXPECT_EQ(ParseQuality("3"), ERTQuality::Epic);
	EXPECT_FALSE(ParseQuality("5"));
	EXPECT_FALSE(ParseQuality(""));
	EXPECT_FALSE(ParseQuality("ultra"));
	for (const ERTQuality Quality : {ERTQuality::Low, ERTQuality::Medium, ERTQuality::High, ERTQuality::Epic, ERTQuality::Cinematic})
		EXPECT_EQ(ParseQuality(ToString(Quality)), Quality);
}

TEST_F(Config, TheOrderOfLoadingDecidesNothing)
{
	Files.Write("ConsoleVariableAliases.ini", "");
	Files.Write("DefaultLantern.ini", "[SystemSettings]\nt.Config.A=1\n");
	Files.Write("Scalability.ini", "[Q@2]\nt.Config.A=2\n");
	Files.Write("DeviceProfiles.ini", "[Default DeviceProfile]\n+CVars=t.Config.A=3\n");
	LoadDeviceProfile(Folder, "any");
	LoadScalability(Folder, ERTQuality::High);
	LoadDefaults(Folder);
	EXPECT_EQ(CVarA.Get(), 3);
	EXPECT_EQ(CVarA.GetSetBy(), ERTSetBy::DeviceProfile);
	EXPECT_FALSE(FConsoleVariables::Get().Set("t.Config.A", "4", ERTSetBy::CommandLine, "--set"));
	LoadDeviceProfile(Folder, "any");
	EXPECT_EQ(CVarA.Get(), 4);
	EXPECT_THAT(Log.GetTexts(), IsEmpty());
}

constexpr const char* Profiles = "[Default DeviceProfile]\nDeviceType=LanternGPU\n+CVars=t.Config.A=1\n"
                                 "+CVars=t.Config.B=1\n"
                                 "[Cpu DeviceProfile]\nBaseProfileName=Default\n+MatchDevice=llvmpipe\n"
                                 "+MatchDevice=Swift*\n+CVars=t.Config.A=2\n"
                                 "[CpuOld DeviceProfile]\nBaseProfileName=cpu\nMatchDevice=*version ?\n"
                                 "-CVars=t.Config.B=1\n+CVars=t.Config.Text=a=b\n";

TEST_F(Config, TheDeviceChoosesItsProfile)
{
	Files.Write("DeviceProfiles.ini", Profiles);
	EXPECT_EQ(LoadDeviceProfile(Folder, "LLVMpipe (LLVM 15.0.6, 256 bits)").Profile, "Cpu");
	EXPECT_EQ(CVarA.Get(), 2);
	EXPECT_EQ(CVarB.Get(), 1) << "inherited";
	EXPECT_EQ(CVarA.GetSetBy(), ERTSetBy::DeviceProfile);
	EXPECT_EQ(LoadDeviceProfile(Folder, "SwiftShader").Profile, "Cpu");
	EXPECT_EQ(LoadDeviceProfile(Folder, "My SwiftShader").Profile, "Default") << "a pattern means the whole name";
	EXPECT_EQ(LoadDeviceProfile(Folder, "").Profile, "Default");
	EXPECT_EQ(CVarA.Get(), 1);
	EXPECT_THAT(Log.GetTexts(), IsEmpty());
}

TEST_F(Config, AProfileMayTakeAwayWhatItInherits)
{
	Files.Write("DeviceProfiles.ini", Profiles);
	EXPECT_EQ(LoadDeviceProfile(Folder, "old version 3").Profile, "CpuOld");
	EXPECT_EQ(CVarA.Get(), 2);
	EXPECT_EQ(CVarB.GetSetBy(), ERTSetBy::Code);
	EXPECT_EQ(CVarText.Get(), "a=b");
}

TEST_F(Config, ProfileMistakesAreNamed)
{
	Files.Write("DeviceProfiles.ini", "[A DeviceProfile]\nMatchDevice=a\nBaseProfileName=B\n+CVars=t.Config.A=5\n"
	                                  "+CVars=t.Config.B\n+CVar=t.Config.B=3\n"
	                                  "[B DeviceProfile]\nBaseProfileName=A\n"
	                                  "[C DeviceProfile]\nMatchDevice=c\nBaseProfileName=None\n+CVars=t.Config.B=4\n"
	                                  "[Nothing]\n");
	FConfigProblems Problems = Checked(LoadDeviceProfile(Folder, "a").Problems);
	EXPECT_THAT(Problems, ElementsAre(HasSubstr(":6: unknown key 'CVar' in a device profile; the nearest is 'CVars'"),
	                          HasSubstr(":13: [Nothing] is not [NAME DeviceProfile]"),
	                          HasSubstr(":8: base profile 'A' is derived from this one"), HasSubstr(":5: 't.Config.B' is not name=value")));
	EXPECT_EQ(CVarA.Get(), 5);
	EXPECT_THAT(LoadDeviceProfile(Folder, "c").Problems, testing::Contains(HasSubstr(":11: base profile 'None' does not exist")));
	EXPECT_EQ(CVarB.Get(), 4);
	EXPECT_EQ(LoadDeviceProfile(Folder, "zzz").Profile, "") << "no Default in this file";
}

TEST_F(Config, ALongChainOfProfilesEnds)
{
	std::string Text = "[P0 DeviceProfile]\nMatchDevice=x\nBaseProfileName=P1\n";
	for (int I = 1; I < 3000; ++I) Text += "[P" + std::to_string(I) + " DeviceProfile]\nBaseProfileName=P" + std::to_string(I + 1) + "\n";
	Files.Write("DeviceProfiles.ini", Text);
	EXPECT_THAT(LoadDeviceProfile(Folder, "x").Problems, ElementsAre(HasSubstr("more than 16 steps away")));
}

TEST_F(Config, AliasMistakesAreNamed)
{
	Files.Write("ConsoleVariableAliases.ini",
	    "[ConsoleVariableAliases]\nx.Config.Empty=\nx.Config.Self=x.Config.Self\nx.Config.Good=t.Config.A\n"
	    "x.Config.Odd=t.Config.A * x\nx.Config.None=t.Config.A * 0\nx.Config.Half=t.Config.A * 0.5\n[X]\n");
	EXPECT_THAT(Checked(LoadAliases(Folder)), ElementsAre(HasSubstr(":2: 'x.Config.Empty' names no other variable"), HasSubstr(":3: "),
	                                              HasSubstr(":5: 't.Config.A * x': the factor behind * is not a number, or 0"),
	                                              HasSubstr(":6: "), HasSubstr(":8: unknown section [X]")));
	EXPECT_EQ(FConsoleVariables::Get().Find("x.config.good"), &CVarA);
	EXPECT_EQ(FConsoleVariables::Get().Find("x.config.odd"), nullptr);
	EXPECT_EQ(FConsoleVariables::Get().Find("x.config.half"), &CVarA);
}

TEST_F(Config, AllNamesOfAFolderAreListed)
{
	Files.Write("DefaultLantern.ini", "[SystemSettings]\na.A=1\n-a.Gone=1\n[ScalabilityGroups]\nsg.Q=1\n");
	Files.Write("Scalability.ini", "[Q@0]\nb.B=1\n[Q@4]\nc.C=1\n");
	Files.Write("DeviceProfiles.ini", "[D DeviceProfile]\nMatchDevice=x\n+CVars= d.D = 1\n-CVars=e.E=2\n!CVars\n");
	Files.Write("ConsoleVariableAliases.ini", "[ConsoleVariableAliases]\nz.Z=f.F\n");
	std::vector<std::string> Names;
	for (const FConfigReference& Reference : ListConsoleVariables(Folder))
		Names.push_back(Reference.Name + Reference.Where.substr(Reference.Where.rfind('/')));
	EXPECT_THAT(
	    Names, ElementsAre("a.A/DefaultLantern.ini:2", "a.Gone/DefaultLantern.ini:3", "b.B/Scalability.ini:2", "c.C/Scalability.ini:4",
	               "d.D/DeviceProfiles.ini:3", "e.E/DeviceProfiles.ini:4", "f.F/ConsoleVariableAliases.ini:2"));
	EXPECT_THAT(Log.GetTexts(), IsEmpty());
}

// The files that we ship.

const FConfigFolder Shipped{LANTERN_SOURCE_DIR "/Config"};

TEST(ShippedConfig, Parses)
{
	for (const std::string& Path : {Shipped.GetDefaults(), Shipped.GetScalability(), Shipped.GetDeviceProfiles(), Shipped.GetAliases()})
	{
		const FIniFile File = FIniFile::Load(Path);
		EXPECT_THAT(File.GetProblems(), IsEmpty());
		EXPECT_FALSE(File.GetSections().empty()) << Path;
	}
	EXPECT_FALSE(ListConsoleVariables(Shipped).empty());
}

TEST(ShippedConfig, EveryGroupSetsTheSameVariablesAtEveryLevel)
{
	std::map<std::string, std::map<std::string, std::set<std::string>>> Groups;
	const FIniFile File = FIniFile::Load(Shipped.GetScalability());
	for (const FIniSection& Section : File.GetSections())
	{
		const size_t At = Section.Name.find('@');
		ASSERT_NE(At, std::string::npos);
		for (const FIniEntry& Entry : Section.Entries) Groups[Section.Name.substr(0, At)][Section.Name.substr(At + 1)].insert(Entry.Key);
	}
	ASSERT_FALSE(Groups.empty());
	for (const auto& [Group, Levels] : Groups)
	{
		EXPECT_EQ(Levels.size(), 5u) << Group;
		for (const auto& [Level, Keys] : Levels) EXPECT_EQ(Keys, Levels.begin()->second) << Group << "@" << Level;
	}
}

/// A profile outranks the quality: what one of them set, no level could change.
TEST(ShippedConfig, ProfilesLeaveQualityAlone)
{
	std::set<std::string> OfQuality;
	const FIniFile Levels = FIniFile::Load(Shipped.GetScalability()), Devices = FIniFile::Load(Shipped.GetDeviceProfiles());
	for (const FIniSection& Section : Levels.GetSections())
	{
		for (const FIniEntry& Entry : Section.Entries) { OfQuality.insert(Entry.Key); }
	}
	size_t Count = 0;
	for (const FIniSection& Section : Devices.GetSections())
	{
		for (const FIniEntry& Entry : Section.Entries)
		{
			if (Entry.Key != "CVars") { continue; }
			++Count;
			EXPECT_EQ(OfQuality.count(Entry.Value.substr(0, Entry.Value.find('='))), 0u) << Section.Name << ": " << Entry.Value;
		}
	}
	EXPECT_GT(Count, 0u);
}

/// The levels that the design of lights asks for. Worse levels leave out more, and have less memory.
TEST(ShippedConfig, LevelsRiseWithQuality)
{
	std::map<std::string, std::map<int, double>> Values;
	const FIniFile File = FIniFile::Load(Shipped.GetScalability());
	for (const FIniSection& Section : File.GetSections())
	{
		for (const FIniEntry& Entry : Section.Entries) { Values[Entry.Key][Section.Name.back() - '0'] = std::stod(Entry.Value); }
	}
	for (const char* const Name : {"r.RT.Shadow.Samples", "r.RT.Shadow.MoreRays", "r.RT.Rays.QueuePerPixel", "r.RT.Lights.Exact",
	         "r.RT.Lights.Rays", "r.RT.Lights.Candidates", "r.RT.Lights.Emissive"})
	{
		for (int Level = 1; Level < 5; ++Level) { EXPECT_GE(Values[Name][Level], Values[Name][Level - 1]) << Name << Level; }
	}
	for (const char* const Name :
	    {"r.RT.Culling.Shadow.MinPixels", "r.RT.Lights.HalfResolution", "r.RT.GI.HalfResolution", "r.RT.Fog.PixelSize"})
	{
		for (int Level = 1; Level < 5; ++Level) { EXPECT_LE(Values[Name][Level], Values[Name][Level - 1]) << Name << Level; }
		EXPECT_GT(Values[Name][0], Values[Name][4]) << Name;
	}
	EXPECT_EQ(Values["r.RT.Culling.Shadow.MinPixels"][4], 0.0) << "everything casts at the best level";
}

TEST(ShippedConfig, KnownDevicesFindTheirProfile)
{
	FLogCapture Log; // the variables are the plugin's and not known in this program
	EXPECT_EQ(LoadDeviceProfile(Shipped, "llvmpipe (LLVM 19.1.4, 256 bits)").Profile, "CPU");
	EXPECT_EQ(LoadDeviceProfile(Shipped, "NVIDIA H200").Profile, "NVIDIA");
	EXPECT_EQ(LoadDeviceProfile(Shipped, "AMD Radeon RX 6800 XT (RADV NAVI21)").Profile, "AMD");
	EXPECT_EQ(LoadDeviceProfile(Shipped, "Intel(R) Arc(tm) A770").Profile, "Intel");
	for (const char* const Phone :
	    {"Adreno (TM) 750", "Turnip Adreno (TM) 740", "Mali-G715-Immortalis MC11", "PowerVR DXT-48-1536 MC1", "Samsung Xclipse 940"})
	{
		EXPECT_EQ(LoadDeviceProfile(Shipped, Phone).Profile, "Mobile") << Phone;
	}
	EXPECT_EQ(LoadDeviceProfile(Shipped, "Some new device").Profile, "Default");
	for (const std::string& Text : Log.GetTexts()) EXPECT_THAT(Text, HasSubstr("unknown console variable 'r.RT."));
}

} // namespace
} // namespace Lantern
