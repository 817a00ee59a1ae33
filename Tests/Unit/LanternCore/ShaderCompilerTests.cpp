// FShaderCompiler: stages, includes, error text. Needs no device.
#include <gmock/gmock.h>
#include <spirv-tools/libspirv.hpp>

#include "ShaderCompilerTestBase.h"

using namespace Lantern;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

namespace
{

using ShaderCompilerTest = FShaderCompilerTestBase;

std::string Validate(const std::vector<uint32_t>& Words)
{
	std::string Message;
	spvtools::SpirvTools Tools(SPV_ENV_VULKAN_1_3);
	Tools.SetMessageConsumer(
	    [&](spv_message_level_t, const char*, const spv_position_t&, const char* Text) { Message += std::string(Text) + "\n"; });
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
	    {ERTShaderStage::Vertex, "Vertex", "#version 460\nvoid main() { gl_Position = vec4(gl_VertexIndex); }", "OpStore"},
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
	        In + "hitAttributeEXT vec2 Bary;\nvoid main() { Payload.Color = vec3(Bary, 0); Payload.T = gl_HitTEXT; }", "HitAttribute"},
	    {ERTShaderStage::AnyHit, "AnyHit",
	        In + "hitAttributeEXT vec2 Bary;\nvoid Reject() { ignoreIntersectionEXT; }\n"
	             "void main() { if (Bary.x > 0.5) { Reject(); } Payload.T += 1.0; if (Payload.T > 3.0) { terminateRayEXT; "
	             "} }",
	        "OpIgnoreIntersectionKHR"},
	    {ERTShaderStage::Intersection, "Intersection",
	        Head + "hitAttributeEXT vec2 Bary;\nvoid main() { Bary = vec2(1); reportIntersectionEXT(gl_RayTminEXT, 0u); }",
	        "OpReportIntersectionKHR"},
	    {ERTShaderStage::Callable, "Callable",
	        Head + "layout(location = 0) callableDataInEXT FPayload Data;\nvoid main() { Data.Color *= 2.0; }", "IncomingCallableData"},
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
	const FRTStatus Status =
	    Compiler.Compile({"Query", ERTShaderStage::Compute, {},
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
	const FShaderSource Source{"A", ERTShaderStage::Compute, {}, Compute("float A = 2.0; float B = A * 3.0; Values[0] = B;")};
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
	Write("Pass/Main.comp", Compute("Values[0] = Near() + Far() + Engine();",
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
	const FRTStatus Status = Compiler.Compile(
	    {"Materials/Generated 7", ERTShaderStage::Compute, {}, Compute("Values[0] = Beside();", "#include \"Beside.glsl\"\n")}, Binary);
	EXPECT_TRUE(Status.IsOk()) << Status.Message;
	EXPECT_EQ(Binary.Name, "Materials/Generated 7");
}

TEST_F(ShaderCompilerTest, AnIncludeInADeadBranchOrACommentMayBeMissing)
{
	FShaderCompiler Compiler(MakeDesc());
	FShaderBinary Binary;
	const FRTStatus Status =
	    Compiler.Compile({"Shared", ERTShaderStage::Compute, {},
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
	const std::string Text = "#version 460\n#include \"Lib.glsl\"\nlayout(local_size_x = 1) in;\nvoid main() { Nope(); }\n";
	EXPECT_THAT(
	    ErrorOf(Compiler, {"Materials/Rust", ERTShaderStage::Compute, {{"A", "1"}, {"B", "2"}}, Text}), StartsWith("Materials/Rust:4: "));
}

TEST_F(ShaderCompilerTest, DefinesArriveAndDoNotShiftLines)
{
	FShaderCompiler Compiler(MakeDesc());
	const std::string Text = "#version 460\n#if SIZE != 8\n#error no size\n#endif\nlayout(local_size_x = SIZE) "
	                         "in;\nvoid main() { EMPTY X; }\n";
	EXPECT_THAT(ErrorOf(Compiler, {"D", ERTShaderStage::Compute, {{"SIZE", "8"}, {"EMPTY", ""}}, Text}), StartsWith("D:6: "));
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
	for (int I = 0; I < 500; ++I) { Write("C" + std::to_string(I) + ".glsl", "#include \"C" + std::to_string(I + 1) + ".glsl\"\n"); }
	Write("C500.glsl", "");
	FShaderCompiler Compiler(MakeDesc());
	EXPECT_THAT(ErrorOf(Compiler, {"C0.glsl", ERTShaderStage::Compute, {}, {}}), HasSubstr("nested more than"));
}

TEST_F(ShaderCompilerTest, RubbishIsAnErrorNotACrash)
{
	FShaderCompiler Compiler(MakeDesc());
	for (const std::string& Text : {std::string("\0\1\2\xff#include", 13), std::string(100000, '('), std::string("#include \""),
	         std::string("/* never closed"), std::string("#version 9999\nvoid main(){}")})
	{
		EXPECT_NE(ErrorOf(Compiler, {"Rubbish", ERTShaderStage::Compute, {}, Text}), "");
	}
}

} // namespace
