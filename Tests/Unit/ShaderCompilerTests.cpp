// FShaderCompiler: stages, includes, error text, disk cache, threads. Needs no device.
#include <atomic>
#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <mutex>
#include <string>
#include <thread>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <spirv-tools/libspirv.hpp>

#include "LanternCore/Log.h"
#include "LanternCore/ShaderCompiler.h"

namespace fs = std::filesystem;
using namespace Lantern;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

namespace
{

class ShaderCompilerTest : public testing::Test
{
protected:
	void SetUp() override
	{
		std::string Pattern = (fs::temp_directory_path() / "lantern-shaders-XXXXXX").string();
		ASSERT_NE(mkdtemp(Pattern.data()), nullptr);
		Root = Pattern;
		fs::create_directories(Root / "Shaders");
		SetLogSink(
		    [this](ERTLogLevel Level, std::string_view Text)
		    {
			    std::lock_guard Lock(LogMutex);
			    if (Level >= ERTLogLevel::Warning)
			    {
				    Warnings.emplace_back(Text);
			    }
		    });
	}
	void TearDown() override
	{
		SetLogSink({});
		std::error_code Code;
		fs::permissions(Root, fs::perms::owner_all, fs::perm_options::add, Code);
		fs::remove_all(Root, Code);
	}

	void Write(const std::string& Path, const std::string& Text, const char* Folder = "Shaders") const
	{
		const fs::path Full = Root / Folder / Path;
		fs::create_directories(Full.parent_path());
		std::ofstream(Full, std::ios::binary) << Text;
	}
	FShaderCompilerDesc MakeDesc(bool bCache = true) const
	{
		FShaderCompilerDesc Desc;
		Desc.SearchFolders = {(Root / "Shaders").string(), (Root / "Engine").string()};
		Desc.CacheFolder = bCache ? (Root / "Cache").string() : "";
		return Desc;
	}
	std::vector<fs::path> CacheFiles() const
	{
		std::vector<fs::path> Files;
		std::error_code Code;
		for (const fs::directory_entry& Entry : fs::directory_iterator(Root / "Cache", Code))
		{
			Files.push_back(Entry.path());
		}
		return Files;
	}

	static std::string Compute(const std::string& Body, const std::string& Before = "")
	{
		return "#version 460\n#extension GL_EXT_scalar_block_layout : require\nlayout(local_size_x = 64) in;\n"
		       "layout(scalar, set = 0, binding = 0) buffer FData { float Values[]; };\n" +
		       Before + "void main() { " + Body + " }\n";
	}
	/// Message of a compile that must fail.
	static std::string ErrorOf(FShaderCompiler& Compiler, const FShaderSource& Source)
	{
		FShaderBinary Binary;
		const FRTStatus Status = Compiler.Compile(Source, Binary);
		EXPECT_EQ(Status.Code, ERTResult::CompileFailed) << "compiled although it must not";
		EXPECT_TRUE(Binary.Words.empty());
		return Status.Message;
	}

	fs::path Root;
	std::mutex LogMutex;
	std::vector<std::string> Warnings;
};

std::string Validate(const std::vector<uint32_t>& Words)
{
	std::string Message;
	spvtools::SpirvTools Tools(SPV_ENV_VULKAN_1_3);
	Tools.SetMessageConsumer([&](spv_message_level_t, const char*, const spv_position_t&, const char* Text)
	                         { Message += std::string(Text) + "\n"; });
	spvtools::ValidatorOptions Options;
	Options.SetScalarBlockLayout(true);
	return Tools.Validate(Words.data(), Words.size(), Options) ? "" : "invalid: " + Message;
}

std::string Disassemble(const std::vector<uint32_t>& Words)
{
	std::string Text;
	spvtools::SpirvTools(SPV_ENV_VULKAN_1_3).Disassemble(Words, &Text, 0);
	return Text;
}

constexpr const char* RayHead = "#version 460\n#extension GL_EXT_ray_tracing : require\n"
                                "struct FPayload { vec3 Color; float T; };\n";

struct FStageCase
{
	ERTShaderStage Stage;
	const char* Model; ///< SPIR-V execution model, less the NV or KHR that the disassembler may choose
	std::string Text;
	const char* MustKeep; ///< an instruction that optimization may not lose
};

std::vector<FStageCase> StageCases()
{
	const std::string Head = RayHead;
	const std::string In = Head + "layout(location = 0) rayPayloadInEXT FPayload Payload;\n";
	return {
	    {ERTShaderStage::Vertex, "Vertex", "#version 460\nvoid main() { gl_Position = vec4(gl_VertexIndex); }",
	     "OpStore"},
	    {ERTShaderStage::Fragment, "Fragment",
	     "#version 460\nlayout(location = 0) out vec4 C;\n"
	     "void main() { if (gl_FragCoord.x < 3.0) { discard; } C = vec4(1); }",
	     "OpStore"},
	    {ERTShaderStage::Compute, "GLCompute",
	     "#version 460\nlayout(local_size_x = 8, local_size_y = 8) in;\nlayout(set = 0, binding = 0) buffer B { uint "
	     "V[]; };\n"
	     "void main() { V[gl_GlobalInvocationID.x] = 3u; }",
	     "LocalSize 8 8 1"},
	    {ERTShaderStage::RayGen, "RayGeneration",
	     Head + "layout(location = 0) rayPayloadEXT FPayload Payload;\n"
	            "layout(set = 0, binding = 3) uniform accelerationStructureEXT Scene;\n"
	            "layout(set = 0, binding = 1, rgba16f) uniform image2D Image;\n"
	            "void main() { Payload.T = 1.0; traceRayEXT(Scene, 0u, 0xffu, 0, 1, 0, vec3(0), 0.0, vec3(0, 0, 1), "
	            "9.0, 0);\n"
	            "imageStore(Image, ivec2(gl_LaunchIDEXT.xy), vec4(Payload.Color, Payload.T)); }",
	     "OpTraceRayKHR"},
	    {ERTShaderStage::Miss, "Miss", In + "void main() { Payload.Color = vec3(1); }", "IncomingRayPayload"},
	    {ERTShaderStage::ClosestHit, "ClosestHit",
	     In + "hitAttributeEXT vec2 Bary;\nvoid main() { Payload.Color = vec3(Bary, 0); Payload.T = gl_HitTEXT; }",
	     "HitAttribute"},
	    {ERTShaderStage::AnyHit, "AnyHit",
	     In + "hitAttributeEXT vec2 Bary;\nvoid Reject() { ignoreIntersectionEXT; }\n"
	          "void main() { if (Bary.x > 0.5) { Reject(); } Payload.T += 1.0; if (Payload.T > 3.0) { terminateRayEXT; "
	          "} }",
	     "OpIgnoreIntersectionKHR"},
	    {ERTShaderStage::Intersection, "Intersection",
	     Head + "hitAttributeEXT vec2 Bary;\nvoid main() { Bary = vec2(1); reportIntersectionEXT(gl_RayTminEXT, 0u); }",
	     "OpReportIntersectionKHR"},
	    {ERTShaderStage::Callable, "Callable",
	     Head + "layout(location = 0) callableDataInEXT FPayload Data;\nvoid main() { Data.Color *= 2.0; }",
	     "IncomingCallableData"},
	};
}

TEST_F(ShaderCompilerTest, EveryStageGivesValidSpirvOptimizedOrNot)
{
	for (const bool bOptimize : {false, true})
	{
		FShaderCompilerDesc Desc = MakeDesc(false);
		Desc.bOptimize = bOptimize;
		FShaderCompiler Compiler(Desc);
		for (const FStageCase& Case : StageCases())
		{
			SCOPED_TRACE(Case.Model);
			FShaderBinary Binary;
			const FRTStatus Status = Compiler.Compile({"Stage", Case.Stage, {}, Case.Text}, Binary);
			ASSERT_TRUE(Status.IsOk()) << Status.Message;
			EXPECT_EQ(Validate(Binary.Words), "");
			const std::string Text = Disassemble(Binary.Words);
			EXPECT_THAT(Text, HasSubstr(std::string("OpEntryPoint ") + Case.Model));
			EXPECT_THAT(Text, HasSubstr(Case.MustKeep));
			EXPECT_EQ(Binary.GetCode().Stage, Case.Stage);
			EXPECT_EQ(Binary.GetCode().WordCount, Binary.Words.size());
			EXPECT_STREQ(Binary.GetCode().Name, "Stage");
		}
		EXPECT_EQ(Compiler.GetStats().Compiled, StageCases().size());
	}
}

TEST_F(ShaderCompilerTest, RayQueryBufferReferencesAndBindlessArraysCompile)
{
	FShaderCompiler Compiler(MakeDesc(false));
	FShaderBinary Binary;
	const FRTStatus Status = Compiler.Compile(
	    {"Query",
	     ERTShaderStage::Compute,
	     {},
	     "#version 460\n#extension GL_EXT_ray_query : require\n#extension GL_EXT_buffer_reference2 : require\n"
	     "#extension GL_EXT_nonuniform_qualifier : require\n#extension GL_EXT_scalar_block_layout : require\n"
	     "#extension GL_EXT_shader_explicit_arithmetic_types_int64 : require\n"
	     "layout(local_size_x = 8) in;\nlayout(buffer_reference, scalar) buffer FOut { float V[]; };\n"
	     "layout(push_constant, scalar) uniform P { uint64_t Address; uint Scene; } Push;\n"
	     "layout(set = 0, binding = 3) uniform accelerationStructureEXT Scenes[];\n"
	     "void main() { rayQueryEXT Q; rayQueryInitializeEXT(Q, Scenes[nonuniformEXT(Push.Scene)], 4u, 255u, vec3(0), "
	     "0.0,\n"
	     "vec3(0, 0, 1), 9.0); while (rayQueryProceedEXT(Q)) {}\n"
	     "FOut(Push.Address).V[gl_GlobalInvocationID.x] = rayQueryGetIntersectionTEXT(Q, true); }"},
	    Binary);
	ASSERT_TRUE(Status.IsOk()) << Status.Message;
	EXPECT_EQ(Validate(Binary.Words), "");
}

TEST_F(ShaderCompilerTest, OptimizingMakesItSmaller)
{
	const FShaderSource Source{
	    "A", ERTShaderStage::Compute, {}, Compute("float A = 2.0; float B = A * 3.0; Values[0] = B;")};
	FShaderBinary Plain, Optimized;
	FShaderCompilerDesc Desc = MakeDesc(false);
	ASSERT_TRUE(FShaderCompiler(Desc).Compile(Source, Optimized).IsOk());
	Desc.bOptimize = false;
	ASSERT_TRUE(FShaderCompiler(Desc).Compile(Source, Plain).IsOk());
	EXPECT_LT(Optimized.Words.size(), Plain.Words.size());
}

TEST_F(ShaderCompilerTest, DebugInfoNamesTheFile)
{
	FShaderCompilerDesc Desc = MakeDesc(false);
	Desc.bDebugInfo = true;
	FShaderBinary Binary;
	FShaderCompiler Compiler(Desc);
	Write("Some.comp", Compute("Values[0] = 1.0;"));
	const FRTStatus Status = Compiler.Compile({"Some.comp", ERTShaderStage::Compute, {}, {}}, Binary);
	ASSERT_TRUE(Status.IsOk()) << Status.Message;
	EXPECT_THAT(Disassemble(Binary.Words), HasSubstr("\"Some.comp\""));
}

// ------------------------------------------------------------------------------------------------ includes

TEST_F(ShaderCompilerTest, IncludesAreFoundBesideTheIncluderFirstThenInTheFolders)
{
	Write("Pass/Main.comp",
	      Compute("Values[0] = Near() + Far() + Engine();",
	              "#include \"Local.glsl\"\n#include \"Library/Far.glsl\"\n#include <Theirs.glsl>\n"));
	Write("Pass/Local.glsl", "#include \"../Shared/Up.glsl\"\nfloat Near() { return Up(); }\n");
	Write("Local.glsl", "#error the wrong one\n");
	Write("Shared/Up.glsl", "float Up() { return 1.0; }\n");
	Write("Library/Far.glsl", "float Far() { return 2.0; }\n");
	Write("Theirs.glsl", "float Engine() { return 3.0; }\n", "Engine");
	FShaderCompiler Compiler(MakeDesc());
	FShaderBinary Binary;
	const FRTStatus Status = Compiler.Compile({"Pass/Main.comp", ERTShaderStage::Compute, {}, {}}, Binary);
	EXPECT_TRUE(Status.IsOk()) << Status.Message;
}

TEST_F(ShaderCompilerTest, EqualRelativePathsInTwoFoldersAreNotMixedUp)
{
	Write("A/Value.glsl", "float Value() { return 1.0; }\n");
	Write("A/Value.glsl", "float Value() { return syntax error; }\n", "Engine");
	Write("A/Use.glsl", "#include \"Value.glsl\"\n", "Engine");
	Write("Main.comp", Compute("Values[0] = Value();", "#include \"A/Use.glsl\"\n"));
	FShaderCompiler Compiler(MakeDesc());
	const std::string Error = ErrorOf(Compiler, {"Main.comp", ERTShaderStage::Compute, {}, {}});
	EXPECT_THAT(Error, StartsWith((Root / "Engine/A/Value.glsl").string() + ":1:"));
}

TEST_F(ShaderCompilerTest, GeneratedTextIncludesAsIfItLayAtItsPath)
{
	Write("Materials/Beside.glsl", "float Beside() { return 1.0; }\n");
	FShaderCompiler Compiler(MakeDesc());
	FShaderBinary Binary;
	const FRTStatus Status = Compiler.Compile({"Materials/Generated 7",
	                                           ERTShaderStage::Compute,
	                                           {},
	                                           Compute("Values[0] = Beside();", "#include \"Beside.glsl\"\n")},
	                                          Binary);
	EXPECT_TRUE(Status.IsOk()) << Status.Message;
	EXPECT_EQ(Binary.Name, "Materials/Generated 7");
}

TEST_F(ShaderCompilerTest, AnIncludeInADeadBranchOrACommentMayBeMissing)
{
	FShaderCompiler Compiler(MakeDesc());
	FShaderBinary Binary;
	const FRTStatus Status =
	    Compiler.Compile({"Shared",
	                      ERTShaderStage::Compute,
	                      {},
	                      Compute("Values[0] = 1.0;", "#ifdef __cplusplus\n#include <cstdint>\n#endif\n"
	                                                  "// #include \"Gone.glsl\"\n/*\n#include \"Gone.glsl\"\n*/\n")},
	                     Binary);
	EXPECT_TRUE(Status.IsOk()) << Status.Message;
}

// --------------------------------------------------------------------------------------------------- errors

TEST_F(ShaderCompilerTest, AnErrorThreeIncludesDeepNamesThatFileAndLine)
{
	Write("Main.comp", Compute("Values[0] = 1.0;", "#include \"One/One.glsl\"\n"));
	Write("One/One.glsl", "// one\n#include \"Two.glsl\"\n");
	Write("One/Two.glsl", "\n\n#include \"../Three.glsl\"\n");
	Write("Three.glsl", "float Fine() { return 1.0; }\n\n\nfloat Broken() { return Undeclared; }\n");
	FShaderCompiler Compiler(MakeDesc());
	const std::string Error = ErrorOf(Compiler, {"Main.comp", ERTShaderStage::Compute, {}, {}});
	EXPECT_THAT(Error, StartsWith("Three.glsl:4: "));
	EXPECT_THAT(Error, HasSubstr("Undeclared"));
	EXPECT_THAT(Error, Not(HasSubstr("ERROR")));
	EXPECT_THAT(Error, Not(HasSubstr("No code generated")));
	EXPECT_EQ(Compiler.GetStats().Failed, 1u);
	EXPECT_TRUE(CacheFiles().empty());
}

TEST_F(ShaderCompilerTest, AnErrorAfterAnIncludeNamesTheIncluderAgain)
{
	Write("Lib.glsl", "float F() { return 1.0; }\n\n\n\n");
	FShaderCompiler Compiler(MakeDesc());
	const std::string Text =
	    "#version 460\n#include \"Lib.glsl\"\nlayout(local_size_x = 1) in;\nvoid main() { Nope(); }\n";
	EXPECT_THAT(ErrorOf(Compiler, {"Materials/Rust", ERTShaderStage::Compute, {{"A", "1"}, {"B", "2"}}, Text}),
	            StartsWith("Materials/Rust:4: "));
}

TEST_F(ShaderCompilerTest, DefinesArriveAndDoNotShiftLines)
{
	FShaderCompiler Compiler(MakeDesc());
	const std::string Text = "#version 460\n#if SIZE != 8\n#error no size\n#endif\nlayout(local_size_x = SIZE) "
	                         "in;\nvoid main() { EMPTY X; }\n";
	EXPECT_THAT(ErrorOf(Compiler, {"D", ERTShaderStage::Compute, {{"SIZE", "8"}, {"EMPTY", ""}}, Text}),
	            StartsWith("D:6: "));
	EXPECT_THAT(ErrorOf(Compiler, {"D", ERTShaderStage::Compute, {{"SIZE", "9"}}, Text}), StartsWith("D:3: "));
	EXPECT_THAT(ErrorOf(Compiler, {"D", ERTShaderStage::Compute, {{"9SIZE", "9"}}, Text}), HasSubstr("9SIZE"));
	EXPECT_THAT(ErrorOf(Compiler, {"D", ERTShaderStage::Compute, {{"A", "1\n#error"}}, Text}), HasSubstr("one line"));
}

TEST_F(ShaderCompilerTest, AMissingIncludeNamesWhoWantedIt)
{
	Write("Main.comp", Compute("Values[0] = 1.0;", "#include \"Mid.glsl\"\n"));
	Write("Mid.glsl", "\n#include \"Nowhere.glsl\"\n");
	FShaderCompiler Compiler(MakeDesc());
	const FShaderSource Source{"Main.comp", ERTShaderStage::Compute, {}, {}};
	const std::string Error = ErrorOf(Compiler, Source);
	EXPECT_THAT(Error, StartsWith("Mid.glsl:2: "));
	EXPECT_THAT(Error, HasSubstr("Nowhere.glsl"));
	EXPECT_THAT(Error, HasSubstr("not found"));
	EXPECT_EQ(Compiler.GetKey(Source), "");
}

TEST_F(ShaderCompilerTest, AMissingShaderNamesTheFoldersSearched)
{
	FShaderCompiler Compiler(MakeDesc());
	const std::string Error = ErrorOf(Compiler, {"No.comp", ERTShaderStage::Compute, {}, {}});
	EXPECT_THAT(Error, StartsWith("No.comp:0: "));
	EXPECT_THAT(Error, HasSubstr((Root / "Engine").string()));
	EXPECT_EQ(Compiler.GetKey({"No.comp", ERTShaderStage::Compute, {}, {}}), "");
}

TEST_F(ShaderCompilerTest, ACycleIsAnErrorThatShowsTheChain)
{
	Write("Main.comp", Compute("Values[0] = 1.0;", "#include \"A.glsl\"\n"));
	Write("A.glsl", "#ifndef A\n#define A\n#include \"B.glsl\"\n#endif\n");
	Write("B.glsl", "#include \"A.glsl\"\n");
	FShaderCompiler Compiler(MakeDesc());
	EXPECT_THAT(ErrorOf(Compiler, {"Main.comp", ERTShaderStage::Compute, {}, {}}),
	            testing::StrEq("B.glsl:1: cyclic include: A.glsl -> B.glsl -> A.glsl"));
}

TEST_F(ShaderCompilerTest, AVeryDeepChainIsAnErrorNotAnOverflow)
{
	for (int I = 0; I < 500; ++I)
	{
		Write("C" + std::to_string(I) + ".glsl", "#include \"C" + std::to_string(I + 1) + ".glsl\"\n");
	}
	Write("C500.glsl", "");
	FShaderCompiler Compiler(MakeDesc());
	EXPECT_THAT(ErrorOf(Compiler, {"C0.glsl", ERTShaderStage::Compute, {}, {}}), HasSubstr("nested more than"));
}

TEST_F(ShaderCompilerTest, RubbishIsAnErrorNotACrash)
{
	FShaderCompiler Compiler(MakeDesc());
	for (const std::string& Text :
	     {std::string("\0\1\2\xff#include", 13), std::string(100000, '('), std::string("#include \""),
	      std::string("/* never closed"), std::string("#version 9999\nvoid main(){}")})
	{
		EXPECT_NE(ErrorOf(Compiler, {"Rubbish", ERTShaderStage::Compute, {}, Text}), "");
	}
}

// ---------------------------------------------------------------------------------------------------- cache

TEST_F(ShaderCompilerTest, TheSecondCompileComesFromTheCacheEvenInANewProcess)
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

TEST_F(ShaderCompilerTest, AnEditDeepInTheIncludesIsNoticed)
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

TEST_F(ShaderCompilerTest, AnOldFileIsReadOnceAndAnEditOfItIsStillNoticed)
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

TEST_F(ShaderCompilerTest, AFileThatAppearsNearerChangesTheKey)
{
	Write("Lib/V.glsl", "float V() { return 1.0; }\n");
	Write("Pass/Main.comp", Compute("Values[0] = V();", "#include \"Lib/V.glsl\"\n"));
	const FShaderSource Source{"Pass/Main.comp", ERTShaderStage::Compute, {}, {}};
	FShaderCompiler Compiler(MakeDesc());
	const std::string Key = Compiler.GetKey(Source);
	Write("Pass/Lib/V.glsl", "float V() { return 4.0; }\n");
	EXPECT_NE(Compiler.GetKey(Source), Key);
}

TEST_F(ShaderCompilerTest, EverythingThatChangesTheResultChangesTheKey)
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
	EXPECT_NE(FShaderCompiler(Desc).GetKey(Base), FShaderCompiler(Desc).GetKey(Renamed))
	    << "its debug info has the name";
}

TEST_F(ShaderCompilerTest, ACorruptCacheFileIsReplacedWithOneWarning)
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
	for (const std::string& Bad : {std::string(), Bytes.substr(0, 20), Bytes.substr(0, Bytes.size() - 4),
	                               Bytes + "more", Flipped, HugeCount, std::string(Bytes.size(), 'x')})
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

TEST_F(ShaderCompilerTest, AnUnwritableCacheFolderWarnsOnceAndCompilesOn)
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

TEST_F(ShaderCompilerTest, NothingButWholeFilesStandsInTheCacheFolder)
{
	FShaderCompiler Compiler(MakeDesc());
	FShaderBinary Binary;
	ASSERT_TRUE(Compiler.Compile({"A", ERTShaderStage::Compute, {}, Compute("Values[0] = 1.0;")}, Binary).IsOk());
	ASSERT_EQ(CacheFiles().size(), 1u);
	EXPECT_EQ(CacheFiles()[0].filename().string(),
	          Compiler.GetKey({"A", ERTShaderStage::Compute, {}, Compute("Values[0] = 1.0;")}) + ".spv.cache");
}

// -------------------------------------------------------------------------------------------------- threads

TEST_F(ShaderCompilerTest, ThirtyTwoVariantsCompileInParallelAsTheyDoAlone)
{
	constexpr int Variants = 32;
	constexpr int Threads = 8;
	Write("Lib.glsl", "float Poly(float X) { float R = 0.0; for (int I = 0; I < VARIANT; ++I) { R = R * X + float(I); "
	                  "} return R; }\n");
	Write("Main.comp", Compute("Values[gl_GlobalInvocationID.x] = Poly(Values[0]);", "#include \"Lib.glsl\"\n"));
	const auto Source = [](int I) {
		return FShaderSource{"Main.comp", ERTShaderStage::Compute, {{"VARIANT", std::to_string(I)}}, {}};
	};

	FShaderCompiler Compiler(MakeDesc());
	std::vector<FShaderBinary> Binaries(Variants);
	std::atomic<int> Next{0}, Bad{0};
	std::vector<std::thread> Workers;
	for (int T = 0; T < Threads; ++T)
	{
		Workers.emplace_back(
		    [&]
		    {
			    // Every variant twice, so that two threads also race for one cache entry.
			    for (int I = Next++; I < 2 * Variants; I = Next++)
			    {
				    FShaderBinary Binary;
				    Bad += Compiler.Compile(Source(I / 2), Binary).IsOk() ? 0 : 1;
				    if (I % 2 == 0)
				    {
					    Binaries[I / 2] = std::move(Binary);
				    }
			    }
		    });
	}
	for (std::thread& Worker : Workers)
	{
		Worker.join();
	}
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
