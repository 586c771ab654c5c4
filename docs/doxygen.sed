# Makes the comment at the head of a public header the description of the file, for Doxygen.
1i /// @file
1,/^#pragma once/{
  s|^// \(Guarantees.*\)$|///\n/// \1|
  s|^// Limits:$|///\n/// Limits:|
  s|^// Example:$|///\n/// Example:\n///|
  s|^//$|///|
  s|^// |/// |
}
