// Runs the program and keeps what it said.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "Support/CoreTestTools.h"
#include "Support/WaitTools.h"

namespace Lantern
{

struct FProgramRun
{
	int Status = -1; ///< exit status; 128 + signal where it was killed
	std::string Out, Err;
	/// Lines of Err; those that only say what runs (device, times) left out.
	std::vector<std::string> GetMessages() const;
};

struct FProgramOptions
{
	std::vector<std::pair<std::string, std::string>> Environment; ///< beside the test's own
	std::string Folder;                                           ///< to run in; empty: the test's
	/// As a user whom file permissions stop (root is stopped by none).
	bool bUnprivileged = false;
	std::string StandardOutput; ///< file; empty: kept in FProgramRun::Out
	std::string Program;        ///< path; empty: lantern
};

FProgramRun RunProgram(const std::vector<std::string>& Arguments, const FProgramOptions& Options = {});

/// A run that goes on beside the test, until it is killed.
class FProgramProcess
{
public:
	FProgramProcess(const std::vector<std::string>& Arguments, const FProgramOptions& Options = {});
	~FProgramProcess();
	FProgramProcess(const FProgramProcess&) = delete;
	FProgramProcess& operator=(const FProgramProcess&) = delete;
	bool IsRunning();
	void Kill(); ///< SIGKILL, and waits
	/// Killed where it still runs after WaitLimit, which fails the test.
	FProgramRun Wait();

private:
	std::string GetLastLine() const; ///< of what it has said

	std::string Name; ///< its first argument
	int Pid = -1;
	int WaitStatus = 0;
	FTemporaryFolder Files;
};

std::string ReadFile(const std::string& Path);
/// Fails the test where the file is no JSON.
nlohmann::json ReadJson(const std::string& Path);
/// Names in a folder, sorted, hidden ones included.
std::vector<std::string> ListFolder(const std::string& Path);

} // namespace Lantern
