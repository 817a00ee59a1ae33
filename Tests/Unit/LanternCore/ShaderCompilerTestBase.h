// What the tests of the shader compiler share: a folder of their own, caught warnings.
#pragma once

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <mutex>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "LanternCore/Shaders/ShaderCompiler.h"
#include "LanternCore/Text/Log.h"

namespace Lantern
{

namespace fs = std::filesystem;

class FShaderCompilerTestBase : public testing::Test
{
protected:
	void SetUp() override
	{
		std::string Pattern = (fs::temp_directory_path() / "lantern-shaders-XXXXXX").string();
		ASSERT_NE(mkdtemp(Pattern.data()), nullptr);
		Root = Pattern;
		fs::create_directories(Root / "Shaders");
		SetLogSink([this](ERTLogLevel Level, std::string_view Text) {
			std::lock_guard Lock(LogMutex);
			if (Level >= ERTLogLevel::Warning) { Warnings.emplace_back(Text); }
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
		for (const fs::directory_entry& Entry : fs::directory_iterator(Root / "Cache", Code)) { Files.push_back(Entry.path()); }
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

} // namespace Lantern
