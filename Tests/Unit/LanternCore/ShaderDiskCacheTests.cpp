// FShaderCompiler: disk cache, keys, threads. Needs no device.
#include <atomic>
#include <chrono>
#include <thread>

#include <sys/wait.h>
#include <unistd.h>

#include <gmock/gmock.h>

#include "LanternCore/Config/ConsoleVariables.h"
#include "ShaderCompilerTestBase.h"

using namespace Lantern;
using testing::HasSubstr;

namespace
{

using ShaderCacheTest = FShaderCompilerTestBase;

// ---------------------------------------------------------------------------------------------------- cache

TEST_F(ShaderCacheTest, TheSecondCompileComesFromTheCacheEvenInANewProcess)
{
	const FShaderSource Source{"A", ERTShaderStage::Compute, {{"N", "1"}}, Compute("Values[0] = N;")};
	FShaderBinary First, Second;
	FShaderCompiler One(MakeDesc());
	ASSERT_TRUE(One.Compile(Source, First).IsOk());
	EXPECT_FALSE(First.bFromCache);
	FShaderCompiler Two(MakeDesc());
	ASSERT_TRUE(Two.Compile(Source, Second).IsOk());
	EXPECT_TRUE(Second.bFromCache);
	EXPECT_EQ(First.Words, Second.Words);
	EXPECT_EQ(Two.GetStats().CacheHits, 1u);
	EXPECT_EQ(Two.GetStats().Compiled, 0u);
	EXPECT_EQ(CacheFiles().size(), 1u);
	EXPECT_GT(One.GetStats().CompileMs, 0.0);
}

TEST_F(ShaderCacheTest, AnEditDeepInTheIncludesIsNoticed)
{
	Write("Main.comp", Compute("Values[0] = V();", "#include \"One.glsl\"\n"));
	Write("One.glsl", "#include \"Two.glsl\"\n");
	Write("Two.glsl", "float V() { return 1.0; }\n");
	const FShaderSource Source{"Main.comp", ERTShaderStage::Compute, {}, {}};
	FShaderCompiler Compiler(MakeDesc());
	FShaderBinary A, B, C;
	ASSERT_TRUE(Compiler.Compile(Source, A).IsOk());
	const std::string KeyA = Compiler.GetKey(Source);
	Write("Two.glsl", "float V() { return 2.0; }\n"); // same length, within one tick of the file clock
	EXPECT_NE(Compiler.GetKey(Source), KeyA);
	ASSERT_TRUE(Compiler.Compile(Source, B).IsOk());
	EXPECT_FALSE(B.bFromCache);
	EXPECT_NE(A.Words, B.Words);
	Write("Two.glsl", "float V() { return 1.0; }\n");
	EXPECT_EQ(Compiler.GetKey(Source), KeyA);
	ASSERT_TRUE(Compiler.Compile(Source, C).IsOk());
	EXPECT_TRUE(C.bFromCache);
	EXPECT_EQ(A.Words, C.Words);
}

TEST_F(ShaderCacheTest, AnOldFileIsReadOnceAndAnEditOfItIsStillNoticed)
{
	Write("Main.comp", Compute("Values[0] = 1.0;"));
	const fs::path Path = Root / "Shaders/Main.comp";
	fs::last_write_time(Path, fs::file_time_type::clock::now() - std::chrono::hours(1));
	const FShaderSource Source{"Main.comp", ERTShaderStage::Compute, {}, {}};
	FShaderCompiler Compiler(MakeDesc());
	const std::string Key = Compiler.GetKey(Source);
	EXPECT_EQ(Compiler.GetKey(Source), Key);
	Write("Main.comp", Compute("Values[0] = 2.0;"));
	EXPECT_NE(Compiler.GetKey(Source), Key);
}

TEST_F(ShaderCacheTest, AFileThatAppearsNearerChangesTheKey)
{
	Write("Lib/V.glsl", "float V() { return 1.0; }\n");
	Write("Pass/Main.comp", Compute("Values[0] = V();", "#include \"Lib/V.glsl\"\n"));
	const FShaderSource Source{"Pass/Main.comp", ERTShaderStage::Compute, {}, {}};
	FShaderCompiler Compiler(MakeDesc());
	const std::string Key = Compiler.GetKey(Source);
	Write("Pass/Lib/V.glsl", "float V() { return 4.0; }\n");
	EXPECT_NE(Compiler.GetKey(Source), Key);
}

TEST_F(ShaderCacheTest, EverythingThatChangesTheResultChangesTheKey)
{
	const FShaderSource Base{"A", ERTShaderStage::Compute, {{"N", "1"}}, Compute("Values[0] = 1.0;")};
	FShaderSource Define = Base, Name = Base, Stage = Base, Renamed = Base;
	Define.Defines[0].second = "2";
	Name.Defines[0].first = "M";
	Stage.Stage = ERTShaderStage::RayGen;
	Renamed.Path = "B";
	FShaderCompiler Compiler(MakeDesc());
	const std::string Key = Compiler.GetKey(Base);
	EXPECT_EQ(Key.size(), 32u);
	EXPECT_NE(Compiler.GetKey(Define), Key);
	EXPECT_NE(Compiler.GetKey(Name), Key);
	EXPECT_NE(Compiler.GetKey(Stage), Key);
	EXPECT_EQ(Compiler.GetKey(Renamed), Key) << "equal generated text is to share an entry";
	FShaderCompilerDesc Desc = MakeDesc();
	Desc.bOptimize = false;
	EXPECT_NE(FShaderCompiler(Desc).GetKey(Base), Key);
	Desc.bDebugInfo = true;
	EXPECT_NE(FShaderCompiler(Desc).GetKey(Base), FShaderCompiler(Desc).GetKey(Renamed)) << "its debug info has the name";
}

TEST_F(ShaderCacheTest, ACorruptCacheFileIsReplacedWithOneWarning)
{
	const FShaderSource Source{"A", ERTShaderStage::Compute, {}, Compute("Values[0] = 1.0;")};
	FShaderCompiler Compiler(MakeDesc());
	FShaderBinary Good;
	ASSERT_TRUE(Compiler.Compile(Source, Good).IsOk());
	const fs::path File = CacheFiles().at(0);
	std::ifstream Stream(File, std::ios::binary);
	const std::string Bytes((std::istreambuf_iterator<char>(Stream)), std::istreambuf_iterator<char>());
	std::string Flipped = Bytes, HugeCount = Bytes;
	Flipped[Bytes.size() - 5] ^= 1;
	HugeCount.replace(8, 8, 8, '\xff');
	for (const std::string& Bad : {std::string(), Bytes.substr(0, 20), Bytes.substr(0, Bytes.size() - 4), Bytes + "more", Flipped,
	         HugeCount, std::string(Bytes.size(), 'x')})
	{
		std::ofstream(File, std::ios::binary | std::ios::trunc) << Bad;
		Warnings.clear();
		FShaderBinary Again;
		ASSERT_TRUE(Compiler.Compile(Source, Again).IsOk());
		EXPECT_FALSE(Again.bFromCache);
		EXPECT_EQ(Again.Words, Good.Words);
		ASSERT_EQ(Warnings.size(), 1u);
		EXPECT_THAT(Warnings[0], HasSubstr("corrupt"));
		ASSERT_TRUE(Compiler.Compile(Source, Again).IsOk());
		EXPECT_TRUE(Again.bFromCache) << "the file was not replaced";
	}
}

TEST_F(ShaderCacheTest, AnUnwritableCacheFolderWarnsOnceAndCompilesOn)
{
	// A file where the folder should be: also unwritable for root.
	std::ofstream(Root / "Cache") << "in the way";
	FShaderCompiler Compiler(MakeDesc());
	for (int I = 0; I < 3; ++I)
	{
		FShaderBinary Binary;
		const FShaderSource Source{"A", ERTShaderStage::Compute, {{"N", std::to_string(I)}}, Compute("Values[0] = N;")};
		ASSERT_TRUE(Compiler.Compile(Source, Binary).IsOk());
		EXPECT_FALSE(Binary.Words.empty());
	}
	ASSERT_EQ(Warnings.size(), 1u);
	EXPECT_THAT(Warnings[0], HasSubstr((Root / "Cache").string()));
}

TEST_F(ShaderCacheTest, NothingButWholeFilesStandsInTheCacheFolder)
{
	FShaderCompiler Compiler(MakeDesc());
	FShaderBinary Binary;
	ASSERT_TRUE(Compiler.Compile({"A", ERTShaderStage::Compute, {}, Compute("Values[0] = 1.0;")}, Binary).IsOk());
	ASSERT_EQ(CacheFiles().size(), 1u);
	EXPECT_EQ(CacheFiles()[0].filename().string(),
	    Compiler.GetKey({"A", ERTShaderStage::Compute, {}, Compute("Values[0] = 1.0;")}) + ".spv.cache");
}

// -------------------------------------------------------------------------------------------------- pruning

class ShaderCachePruneTest : public ShaderCacheTest
{
protected:
	using FClock = fs::file_time_type::clock;
	static FShaderSource MakeSource(int Number)
	{
		return {"A", ERTShaderStage::Compute, {{"N", std::to_string(Number)}}, Compute("Values[0] = N;")};
	}
	fs::path WriteFile(const std::string& Name, size_t Bytes, std::chrono::hours Age)
	{
		const fs::path Path = Root / "Cache" / Name;
		fs::create_directories(Path.parent_path());
		std::ofstream(Path, std::ios::binary) << std::string(Bytes, 'x');
		fs::last_write_time(Path, FClock::now() - Age);
		return Path;
	}
	/// The name of an entry that nothing has the key of.
	static std::string MakeEntryName(int Number) { return fmt::format("{:032x}.spv.cache", Number); }
	/// A process that has ended.
	static int MakeDeadProcess()
	{
		const pid_t Child = fork();
		if (Child == 0) { _exit(0); }
		waitpid(Child, nullptr, 0);
		return static_cast<int>(Child);
	}
	void CompileAndClose(int Number, bool bFromCache)
	{
		FShaderCompiler Compiler(MakeDesc());
		FShaderBinary Binary;
		ASSERT_TRUE(Compiler.Compile(MakeSource(Number), Binary).IsOk());
		EXPECT_EQ(Binary.bFromCache, bFromCache);
	}
};

TEST_F(ShaderCachePruneTest, AnEntryThatNobodyUsesGoesAndAUsedOneStays)
{
	CompileAndClose(1, false);
	CompileAndClose(2, false);
	for (const fs::path& File : CacheFiles()) { fs::last_write_time(File, FClock::now() - std::chrono::hours(24 * 61)); }
	CompileAndClose(1, true);
	EXPECT_EQ(CacheFiles().size(), 1u);
	CompileAndClose(1, true);
	CompileAndClose(2, false);
}

TEST_F(ShaderCachePruneTest, TheOldestGoIfThereAreTooManyBytes)
{
	FConsoleVariables::Get().Set("r.RT.ShaderCache.MB", "1", ERTSetBy::Console, "test");
	std::vector<fs::path> Files;
	for (int I = 0; I < 8; ++I) { Files.push_back(WriteFile(MakeEntryName(I), 256 * 1024, std::chrono::hours(1 + I))); }
	CompileAndClose(1, false);
	FConsoleVariables::Get().ResetAll();
	for (int I = 0; I < 8; ++I) { EXPECT_EQ(fs::exists(Files[I]), I < 3) << "hours old: " << 1 + I; }
	CompileAndClose(1, true);
}

TEST_F(ShaderCachePruneTest, TemporaryFilesOfDeadProcessesGoAndOtherFilesStay)
{
	const std::string Entry = MakeEntryName(7), Dead = std::to_string(MakeDeadProcess()), Own = std::to_string(getpid());
	constexpr std::chrono::hours Hour{1}, Days{50};
	const fs::path Left = WriteFile(Entry + "." + Dead + ".3.tmp", 10, Hour);
	const fs::path Fresh = WriteFile(Entry + "." + Dead + ".4.tmp", 10, std::chrono::hours(0));
	const fs::path Written = WriteFile(Entry + "." + Own + ".3.tmp", 10, Hour);
	const fs::path Forgotten = WriteFile(Entry + "." + Own + ".4.tmp", 10, Days);
	const fs::path Others[] = {WriteFile("notes.txt", 10, 2 * Days), WriteFile("x." + Dead + ".3.tmp", 10, 2 * Days),
	    WriteFile(Entry + ".old", 10, 2 * Days), WriteFile(Entry + "." + Dead + ".3.tmp.gz", 10, 2 * Days)};
	CompileAndClose(1, false);
	EXPECT_FALSE(fs::exists(Left));
	EXPECT_TRUE(fs::exists(Fresh)) << "a process of another machine may be writing it";
	EXPECT_TRUE(fs::exists(Written)) << "this process may be writing it";
	EXPECT_FALSE(fs::exists(Forgotten)) << "no write takes a day";
	for (const fs::path& Other : Others) { EXPECT_TRUE(fs::exists(Other)) << Other; }
}

TEST_F(ShaderCachePruneTest, CompilersThatPruneOneFolderAtOnceDisturbNoResult)
{
	constexpr int Variants = 4, Threads = 4, Rounds = 6;
	std::vector<FShaderBinary> Right(Variants);
	FShaderCompiler Alone(MakeDesc(false));
	for (int I = 0; I < Variants; ++I) { ASSERT_TRUE(Alone.Compile(MakeSource(I), Right[I]).IsOk()); }
	std::atomic<int> Bad{0};
	std::vector<std::thread> Workers;
	for (int T = 0; T < Threads; ++T)
	{
		Workers.emplace_back([&] {
			for (int Round = 0; Round < Rounds; ++Round)
			{
				FShaderCompiler Compiler(MakeDesc());
				for (int I = 0; I < Variants; ++I)
				{
					FShaderBinary Binary;
					Bad += Compiler.Compile(MakeSource(I), Binary).IsOk() && Binary.Words == Right[I].Words ? 0 : 1;
					// All of them are old at once, as if months had gone by.
					std::error_code Ignored;
					for (const auto& File : fs::directory_iterator(Root / "Cache", Ignored))
					{
						if (File.path().extension() != ".cache") { continue; }
						fs::last_write_time(File.path(), FClock::now() - std::chrono::hours(24 * 100), Ignored);
					}
				}
			}
		});
	}
	for (std::thread& Worker : Workers) { Worker.join(); }
	EXPECT_EQ(Bad, 0);
	EXPECT_EQ(Warnings, std::vector<std::string>());
}

// -------------------------------------------------------------------------------------------------- threads

TEST_F(ShaderCacheTest, ThirtyTwoVariantsCompileInParallelAsTheyDoAlone)
{
	constexpr int Variants = 32;
	constexpr int Threads = 8;
	Write("Lib.glsl", "float Poly(float X) { float R = 0.0; for (int I = 0; I < VARIANT; ++I) { R = R * X + float(I); "
	                  "} return R; }\n");
	Write("Main.comp", Compute("Values[gl_GlobalInvocationID.x] = Poly(Values[0]);", "#include \"Lib.glsl\"\n"));
	const auto Source = [](int I) { return FShaderSource{"Main.comp", ERTShaderStage::Compute, {{"VARIANT", std::to_string(I)}}, {}}; };

	FShaderCompiler Compiler(MakeDesc());
	std::vector<FShaderBinary> Binaries(Variants);
	std::atomic<int> Next{0}, Bad{0};
	std::vector<std::thread> Workers;
	for (int T = 0; T < Threads; ++T)
	{
		Workers.emplace_back([&] {
			// Every variant twice, so that two threads also race for one cache entry.
			for (int I = Next++; I < 2 * Variants; I = Next++)
			{
				FShaderBinary Binary;
				Bad += Compiler.Compile(Source(I / 2), Binary).IsOk() ? 0 : 1;
				if (I % 2 == 0) { Binaries[I / 2] = std::move(Binary); }
			}
		});
	}
	for (std::thread& Worker : Workers) { Worker.join(); }
	EXPECT_EQ(Bad, 0);
	EXPECT_EQ(CacheFiles().size(), static_cast<size_t>(Variants));
	EXPECT_EQ(Compiler.GetStats().Compiled + Compiler.GetStats().CacheHits, 2u * Variants);
	FShaderCompiler Alone(MakeDesc(false));
	for (int I = 0; I < Variants; I += 5)
	{
		FShaderBinary Binary;
		ASSERT_TRUE(Alone.Compile(Source(I), Binary).IsOk());
		EXPECT_EQ(Binary.Words, Binaries[I].Words) << I;
	}
}

} // namespace
